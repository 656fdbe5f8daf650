// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_nearest_names_h
#define tetradapt_scene_nearest_names_h

#include <string>
#include <vector>

namespace tetradapt::scene
{
  /**
   * Number of letters to insert, delete, replace or exchange with their
   * neighbour to make one text of the other (the optimal string alignment
   * distance); upper and lower case count as equal.
   */
  unsigned int
  edit_distance(const std::string &a, const std::string &b);

  /**
   * The names of @p valid that @p name was probably meant to be, nearest first,
   * at most three; empty if none is near.
   */
  std::vector<std::string>
  nearest_names(const std::string &name, const std::vector<std::string> &valid);

  /**
   * A sentence for a message about the unknown @p name: "Did you mean 'a'?", or
   * if no valid name is near, "Valid names are 'a', 'b'."
   */
  std::string
  suggest(const std::string &name, const std::vector<std::string> &valid);
} // namespace tetradapt::scene

#endif
