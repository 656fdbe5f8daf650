// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_direct_solver_h
#define tetradapt_solve_direct_solver_h

#include "tetradapt/mechanics/stiffness.h"

namespace tetradapt::solve
{
  /**
   * Solves matrix x = right-hand side by sparse factorisation (KLU of Trilinos'
   * Amesos; on several ranks it works on the first). Collective.
   * @throws core::NumericalError if the matrix is singular.
   */
  void
  solve_directly(const mechanics::BlockMatrix       &matrix,
                 const mechanics::DisplacementSpace &space,
                 const mechanics::Vector            &right_hand_side,
                 mechanics::Vector                  &solution);
} // namespace tetradapt::solve

#endif
