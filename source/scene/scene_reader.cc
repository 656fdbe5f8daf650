// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/scene_reader.h"

#include "consistency.h"
#include "scene_sink.h"

#include <filesystem>

namespace tetradapt::scene
{
  namespace fs = std::filesystem;

  namespace
  {
    std::string
    absolute(const std::string &file, const fs::path &folder)
    {
      if (file.empty())
        return file;
      const fs::path path(file);
      return fs::absolute(path.is_absolute() ? path : folder / path).lexically_normal().string();
    }

    /** @p message with the place in front that it is about, or at least the file. */
    std::string
    placed(const std::string &message, const Scene &scene)
    {
      const std::string with_place = scene.with_place(message);
      return with_place == message ? scene.file + ": " + message : with_place;
    }

    /** What the study varies, as the file and the command line say so far. */
    std::vector<VariationParameters>
    read_variations(const Scene &scene, dealii::ParameterHandler &prm, Mistakes &mistakes)
    {
      Scene whole = scene;
      parse(whole, prm, mistakes);
      for (const auto &variation : whole.variations)
        mistakes.attempt([&]() { variation.check(); });
      return whole.variations;
    }

    /** Sets what the study varies to the values of its @p cases. */
    void
    set_cases(const std::vector<unsigned int> &cases,
              const Scene                     &scene,
              dealii::ParameterHandler        &prm,
              SceneSink                       &sink,
              Mistakes                        &mistakes)
    {
      if (!mistakes.empty())
        return;
      Mistakes   found;
      const auto variations = read_variations(scene, prm, found);
      mistakes.merge(found, [&](const auto &message) { return placed(message, scene); });
      if (found.empty())
        for (std::size_t i = 0; i < cases.size(); ++i)
          mistakes.attempt([&]() { sink.set_case(variations.at(i), cases[i]); });
    }

    Scene
    read(const std::string               &file,
         const std::vector<std::string>  &overrides,
         const std::vector<unsigned int> &cases,
         Mistakes                        &mistakes)
    {
      Scene scene;
      scene.file = file;
      scene.name = fs::path(file).stem().string();
      if (scene.name == "." || scene.name == "..")
        throw core::InputError("'" + file
                               + "' has no name before its ending, by which its "
                                 "results could be called. Rename the file.");
      dealii::ParameterHandler prm;
      declare(scene, prm);
      SceneSink sink(scene, prm, mistakes);
      read_prm(file, sink, mistakes);
      for (const auto &text : overrides)
        if (!mistakes.attempt([&]() { sink.set_override(text); }))
          mistakes.mark_unreadable(text.substr(0, text.find('/')));
      if (!cases.empty())
        set_cases(cases, scene, prm, sink, mistakes);
      Mistakes found = mistakes.marks();
      parse(scene, prm, found);
      if (!cases.empty())
        scene.variations.clear();
      for (auto &name : scene.mesh.files)
        name = absolute(name, sink.folder_of("Mesh/Files"));
      scene.mesh.size_field = absolute(scene.mesh.size_field, sink.folder_of("Mesh/Size field"));
      scene.mesh.projection_file
        = absolute(scene.mesh.projection_file, sink.folder_of("Mesh/Projection file"));
      scene.reference.file = absolute(scene.reference.file, sink.folder_of("Reference/File"));
      check_scene(scene, found);
      mistakes.merge(found, [&](const auto &message) { return placed(message, scene); });
      return scene;
    }
  } // namespace

  Scene
  read_scene(const std::string &file, const std::vector<std::string> &overrides, Mistakes &mistakes)
  {
    return read(file, overrides, {}, mistakes);
  }

  Scene
  read_scene(const std::string &file, const std::vector<std::string> &overrides)
  {
    Mistakes    mistakes;
    const Scene scene = read_scene(file, overrides, mistakes);
    mistakes.throw_if_any(file);
    return scene;
  }

  Scene
  read_study_run(const std::string               &file,
                 const std::vector<std::string>  &overrides,
                 const std::vector<unsigned int> &cases,
                 Mistakes                        &mistakes)
  {
    return read(file, overrides, cases, mistakes);
  }
} // namespace tetradapt::scene
