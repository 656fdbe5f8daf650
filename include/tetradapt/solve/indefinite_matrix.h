// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_indefinite_matrix_h
#define tetradapt_solve_indefinite_matrix_h

#include "tetradapt/core/exceptions.h"

namespace tetradapt::solve
{
  /** A tangent has a direction of negative or no energy, to rounding: the body is not stable. */
  class IndefiniteMatrix : public core::NumericalError
  {
  public:
    IndefiniteMatrix() : NumericalError("The tangent of the body is not positive definite.")
    {
    }
  };
} // namespace tetradapt::solve

#endif
