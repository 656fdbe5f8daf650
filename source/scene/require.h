// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_require_h
#define tetradapt_scene_require_h

#include "tetradapt/core/exceptions.h"
#include "tetradapt/scene/mistakes.h"

#include <string>
#include <vector>

namespace tetradapt::scene
{
  /** @throws InputError "<path>: <text>" unless @p condition holds. @p path is a
   * parameter's full name such as "Mesh/Cells": the reader of the scene finds by
   * it the place to put in front. */
  inline void
  require(const bool condition, const std::string &path, const std::string &text)
  {
    if (!condition)
      throw core::InputError(path + ": " + text);
  }

  /** @throws InputError if the expression @p text depends on t. */
  void
  require_no_time(const std::string &text, const std::string &what);

  /** Whether @p text is an expression without variables; @p value gets its value.
   * @throws InputError if it is no expression, depends on t, or is constant but not
   * finite. */
  bool
  constant_value(const std::string &text, const std::string &what, double &value);

  /** @throws InputError if @p text is no expression, depends on t, or is constant but not
   * finite. */
  void
  check_expression(const std::string &text, const std::string &what);

  /** An edge length given as an expression; a constant must be positive. */
  void
  check_size(const std::string &text, const std::string &path);

  /** @throws InputError unless @p file exists, is a file, can be opened, and its
   * name ends as one of @p endings (lower case, with the dot) does. */
  void
  check_file(const std::string              &file,
             const std::string              &path,
             const std::vector<std::string> &endings);

  /** TetGen's bounds on the quality of tetrahedra. */
  void
  check_quality(double radius_edge_ratio, double dihedral_angle, const std::string &section);
} // namespace tetradapt::scene

#endif
