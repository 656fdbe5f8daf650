// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/load_scene.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mechanics/constitutive_law.h"
#include "tetradapt/scene/nearest_names.h"
#include "tetradapt/scene/scene_reader.h"

#include <algorithm>

namespace tetradapt::cli
{
  scene::Scene
  load_scene(const std::string &file, const Options &options)
  {
    scene::Scene scene = scene::read_scene(file, options.settings);
    const auto   laws  = mechanics::law_names();
    for (const auto &material : scene.materials)
      if (std::find(laws.begin(), laws.end(), material.law) == laws.end())
        throw core::InputError(scene.with_place("Materials/" + material.name
                                                + "/Law: there is no law '" + material.law + "'. "
                                                + scene::suggest(material.law, laws)));
    if (!options.output_directory.empty())
      {
        scene.output.directory = options.output_directory;
        if (options.scenes.size() > 1)
          scene.output.directory += "/" + scene.name;
        scene.places["Output/Directory"] = "command line";
        scene.output.check();
      }
    return scene;
  }
} // namespace tetradapt::cli
