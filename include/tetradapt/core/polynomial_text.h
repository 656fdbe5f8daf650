// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_polynomial_text_h
#define tetradapt_core_polynomial_text_h

#include <string>

namespace tetradapt::core
{
  /**
   * Whether the structure of @p text says that it is a polynomial of x, y, z, nx, ny, nz of
   * degree at most 16: numbers, pi, e, these names, +, -, *, brackets, quotients by a number,
   * powers of names and numbers with an exponent from 0 to 8. "No" may be wrong, "yes" may not, for
   * expressions that core::Expression or core::SurfaceExpression read.
   */
  bool
  is_polynomial(const std::string &text);
} // namespace tetradapt::core

#endif
