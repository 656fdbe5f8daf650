// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_load_scene_h
#define tetradapt_cli_load_scene_h

#include "tetradapt/cli/options.h"
#include "tetradapt/scene/scene.h"

#include <string>
#include <vector>

namespace tetradapt::cli
{
  /**
   * Reads the scene @p file as scene::read_scene() does, also checks what only
   * other rooms know (the names of constitutive laws), and applies
   * Options::output_directory: one scene writes there, several write to folders
   * with their names in it.
   * @throws InputError of all mistakes.
   */
  scene::Scene
  load_scene(const std::string &file, const Options &options);

  /** One run of a study. */
  struct StudyRun
  {
    scene::Scene              scene; ///< without variations, with a directory of its own
    std::vector<unsigned int> cases; ///< of each variation
    std::string               name;  ///< "03-ren-1.2": number and labels, its folder
    std::string               label; ///< "ren, 1.2": for people
  };

  /**
   * Reads all runs of a study, the last variation changing fastest. Each writes to a folder
   * with its name in that of the study.
   * @param study what load_scene() made of the study's file.
   * @throws InputError of the mistakes of all runs, each with the line of the values that are
   *         to blame.
   */
  std::vector<StudyRun>
  load_study(const scene::Scene &study, const Options &options);

  /** How a case of a variation is called: by its label, else by the variation's name and
   * its values. */
  std::string
  case_label(const scene::VariationParameters &variation, unsigned int number);
} // namespace tetradapt::cli

#endif
