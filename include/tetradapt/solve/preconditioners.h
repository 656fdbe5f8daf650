// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_preconditioners_h
#define tetradapt_solve_preconditioners_h

#include "tetradapt/mechanics/stiffness.h"

#include <memory>

namespace tetradapt::solve
{
  using Vector = mechanics::Vector;

  /** What conjugate gradients are preconditioned with: symmetric, positive. */
  class Preconditioner
  {
  public:
    virtual ~Preconditioner() = default;
    /** destination = approximate inverse times source. Collective. */
    virtual void
    vmult(Vector &destination, const Vector &source) const = 0;
  };

  /**
   * Smoothed-aggregation AMG (Trilinos ML) with the six rigid motions as near
   * null space, for a matrix of degree 1. Copies what it needs of the matrix.
   */
  std::unique_ptr<Preconditioner>
  make_amg(const mechanics::BlockMatrix            &matrix,
           const mechanics::DisplacementSpace      &space,
           const mechanics::PrescribedDisplacement &prescribed);

  /**
   * One V-cycle of p-multigrid for a matrix of degree 2: Chebyshev smoothing with
   * 3x3 block Jacobi there, and @p coarse_matrix of degree 1 solved by one cycle
   * of AMG. Keeps references to @p fine_matrix and both spaces.
   */
  std::unique_ptr<Preconditioner>
  make_p_multigrid(const mechanics::BlockMatrix            &fine_matrix,
                   const mechanics::DisplacementSpace      &fine_space,
                   const mechanics::BlockMatrix            &coarse_matrix,
                   const mechanics::DisplacementSpace      &coarse_space,
                   const mechanics::PrescribedDisplacement &prescribed);
} // namespace tetradapt::solve

#endif
