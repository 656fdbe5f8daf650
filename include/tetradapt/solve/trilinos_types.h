// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_trilinos_types_h
#define tetradapt_solve_trilinos_types_h

#include "tetradapt/mechanics/block_matrix.h"
#include "tetradapt/mechanics/supports.h"

#include <deal.II/lac/trilinos_precondition.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>

#include <memory>

/**
 * The only header that names Trilinos; another back end needs another one.
 */
namespace tetradapt::solve
{
  using Vector            = mechanics::Vector;
  using AmgPreconditioner = dealii::TrilinosWrappers::PreconditionAMG;
  using PointMatrix       = Epetra_CrsMatrix;
  using MultiVector       = Epetra_MultiVector;

  /** Copies a block matrix into Trilinos' row format. Collective. */
  std::unique_ptr<PointMatrix>
  to_point_matrix(const mechanics::BlockMatrix &matrix, const mechanics::DisplacementSpace &space);

  /** The six rigid motions on the owned unknowns, zero where prescribed: the near
   * null space that an algebraic multigrid needs for elasticity. */
  std::unique_ptr<MultiVector>
  rigid_body_modes(const PointMatrix                       &matrix,
                   const mechanics::DisplacementSpace      &space,
                   const mechanics::PrescribedDisplacement &prescribed);
} // namespace tetradapt::solve

#endif
