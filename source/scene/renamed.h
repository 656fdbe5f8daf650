// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_renamed_h
#define tetradapt_scene_renamed_h

#include <string>

namespace tetradapt::scene
{
  /**
   * What to tell a user who writes @p full_name, a section or "Section/Parameter" of an
   * earlier version of the program: the name of today, in one or two sentences. Empty if
   * no such name was ever valid. contrib/convert_scene knows the same names.
   */
  std::string
  renamed_to(const std::string &full_name);
} // namespace tetradapt::scene

#endif
