// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_scene_reader_h
#define tetradapt_scene_scene_reader_h

#include "tetradapt/scene/mistakes.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::scene
{
  /**
   * Reads and checks a scene from a parameter file in deal.II's format
   * (`subsection`, `end`, `set`,
   * `include`, comments after #, lines continued by a backslash).
   *
   * Every parameter has a default; the blocks in Materials, Supports and Loads
   * have names that the user chooses. A parameter may be set once in a file; what
   * a file sets after `include` wins over the included file, and @p overrides win
   * over both.
   *
   * @param file name of the file. Files that it names count from the folder of
   *        the file that they are written in, those in @p overrides from the
   *        working directory; the scene holds them as absolute paths.
   * @param overrides texts "Section/Name=value" as given to --set on the command
   *        line. Blocks must exist in the file.
   * @return the scene, which Scene::check() has accepted.
   * @throws InputError "file:line: <name>: <what is wrong and what to change>"; of several
   *         mistakes a list, see Mistakes::throw_if_any().
   */
  Scene
  read_scene(const std::string &file, const std::vector<std::string> &overrides = {});

  /** As above, but what is wrong is added to @p mistakes, with its place; the scene can be used
   * only if that is nothing. */
  Scene
  read_scene(const std::string              &file,
             const std::vector<std::string> &overrides,
             Mistakes                       &mistakes);

  /**
   * One run of a study: reads a scene as read_scene() does, with the parameters that its
   * Scene::variations name set to the values of one case each, as if these values stood in the
   * file where the case is written; they win over everything else. The scene that comes
   * back has no variations.
   *
   * @param cases for each variation the number of the case.
   * @param mistakes gets what is wrong, "file:line: ...", the line being that of the study's
   *        values if these are to blame.
   */
  Scene
  read_study_run(const std::string               &file,
                 const std::vector<std::string>  &overrides,
                 const std::vector<unsigned int> &cases,
                 Mistakes                        &mistakes);
} // namespace tetradapt::scene

#endif
