// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_direct_solver_h
#define tetradapt_solve_direct_solver_h

#include "tetradapt/mechanics/stiffness.h"

#include <memory>

namespace tetradapt::solve
{
  /** A sparse Cholesky factorisation (CHOLMOD of SuiteSparse; on several ranks the first
   * does it alone), which solves for any number of right-hand sides. Copies the matrix. */
  class DirectSolver
  {
  public:
    /** Factorises. Collective. @throws core::NumericalError if @p matrix is not positive
     * definite, or if a pivot is below 1e-14 of its diagonal entry, so that nothing but
     * rounding is left of it: a body that is free to move is never solved.
     * @param may_be_indefinite the error is IndefiniteMatrix then. */
    DirectSolver(const mechanics::BlockMatrix &matrix,
                 const fem::Space             &space,
                 bool                          may_be_indefinite = false);
    ~DirectSolver();

    /** Solves matrix solution = right-hand side. Collective. */
    void
    solve(const mechanics::Vector &right_hand_side, mechanics::Vector &solution) const;

  private:
    struct Factors;
    std::unique_ptr<Factors> factors;
    MPI_Comm                 communicator;
    bool                     is_first_rank;
  };
} // namespace tetradapt::solve

#endif
