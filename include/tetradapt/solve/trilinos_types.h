// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_trilinos_types_h
#define tetradapt_solve_trilinos_types_h

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Epetra_MultiVector.h>

/**
 * The only header that names deal.II's wrappers of Trilinos. ML is called in one file,
 * solve/trilinos_amg.cc.
 */
namespace tetradapt::solve
{
  using SparseMatrix      = dealii::TrilinosWrappers::SparseMatrix;
  using SparsityPattern   = dealii::TrilinosWrappers::SparsityPattern;
  using AmgPreconditioner = dealii::TrilinosWrappers::PreconditionAMG;
  using MultiVector       = Epetra_MultiVector;
} // namespace tetradapt::solve

#endif
