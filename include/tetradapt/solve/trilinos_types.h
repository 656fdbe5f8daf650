// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_trilinos_types_h
#define tetradapt_solve_trilinos_types_h

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

/**
 * The only header that names Trilinos; another back end needs another one.
 */
namespace tetradapt::solve
{
  using SparseMatrix    = dealii::TrilinosWrappers::SparseMatrix;
  using SparsityPattern = dealii::TrilinosWrappers::SparsityPattern;
} // namespace tetradapt::solve

#endif
