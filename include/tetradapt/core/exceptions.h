// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_exceptions_h
#define tetradapt_core_exceptions_h

#include <stdexcept>
#include <string>

namespace tetradapt::core
{
  /**
   * The user's input cannot be used: a parameter, a mesh file, a surface. The
   * message says what is wrong, where (file, line, element, coordinates) and
   * what to change. The program's exit code is 2.
   */
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * The input was accepted but the computation failed: a solver that did not
   * converge, a mesher that crashed or ran out of time. The message says at
   * which stage and what the user can change. The program's exit code is 1.
   */
  class NumericalError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace tetradapt::core

#endif
