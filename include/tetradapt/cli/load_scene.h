// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_load_scene_h
#define tetradapt_cli_load_scene_h

#include "tetradapt/cli/options.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::cli
{
  /**
   * Reads the scene @p file as scene::read_scene() does, checks besides what only
   * other rooms know (the names of constitutive laws), and applies
   * Options::output_directory: one scene writes there, several write to folders
   * with their names in it.
   * @throws InputError.
   */
  scene::Scene
  load_scene(const std::string &file, const Options &options);
} // namespace tetradapt::cli

#endif
