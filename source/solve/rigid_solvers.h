// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_rigid_solvers_h
#define tetradapt_source_solve_rigid_solvers_h

#include "tetradapt/mechanics/rigid_coupling.h"
#include "tetradapt/solve/direct_solver.h"
#include "tetradapt/solve/preconditioners.h"

namespace tetradapt::solve
{
  /** The couplings of a space for the space of degree 1 on the same mesh. */
  std::vector<mechanics::RigidCoupling>
  restrict_to_vertices(const std::vector<mechanics::RigidCoupling> &couplings,
                       unsigned int                                 n_points);

  /** A preconditioner of nodes that takes and gives displacements of coupled nodes that are
   * rigid: Pi B Pi for sources of the form Pi b. */
  class RigidPreconditioner : public Preconditioner
  {
  public:
    /** Keeps a reference to @p couplings. */
    RigidPreconditioner(std::unique_ptr<Preconditioner>  inverse,
                        const mechanics::RigidCouplings &couplings)
      : inverse(std::move(inverse)), couplings(couplings)
    {
    }
    void
    vmult(Vector &destination, const Vector &source) const override
    {
      inverse->vmult(destination, source);
      couplings.project(destination);
    }
    void
    set_smoother_degree(const unsigned int degree) override
    {
      inverse->set_smoother_degree(degree);
    }

  private:
    std::unique_ptr<Preconditioner>  inverse;
    const mechanics::RigidCouplings &couplings;
  };

  /**
   * A factorisation of the matrix in which coupled nodes are fixed, and the free motions
   * of the reference points eliminated after it. With A in blocks of other nodes (1) and motions
   * (2), A^-1 = (A_11^-1, 0; 0, 0) + W S^-1 W^T, with W = (-A_11^-1 A_12; 1) and S = W^T A W.
   */
  class RigidDirectSolver
  {
  public:
    /** Collective. @p matrix has no supports at the coupled nodes. Keeps a reference to
     * @p couplings. @throws core::NumericalError as DirectSolver does, also for reference points
     * that are free to move. */
    RigidDirectSolver(const mechanics::BlockMatrix    &matrix,
                      const fem::Space                &space,
                      const mechanics::RigidCouplings &couplings);

    /** Solves Pi K Pi solution = right-hand side, both of the form Pi v. Collective. */
    void
    solve(const Vector &right_hand_side, Vector &solution) const;

  private:
    const mechanics::RigidCouplings &couplings;
    std::unique_ptr<DirectSolver>    fixed;
    std::vector<Vector>              motions; ///< the columns of W
    std::vector<double>              inverse; ///< of S, row by row
  };
} // namespace tetradapt::solve

#endif
