// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/direct_solver.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/solve/trilinos_types.h"

#include <Amesos.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Vector.h>

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    [[noreturn]] void
    throw_singular()
    {
      throw core::NumericalError(
        "The direct solver could not factorise the stiffness matrix: it is singular to rounding. "
        "Look for elements with almost no volume, or set Solver/Type = cg.");
    }
  } // namespace

  struct DirectSolver::Factors
  {
    Factors(const mechanics::BlockMatrix &block_matrix, const mechanics::DisplacementSpace &space)
      : matrix(to_point_matrix(block_matrix, space)), x(matrix->RowMap()), b(matrix->RowMap()),
        problem(matrix.get(), &x, &b), solver(Amesos().Create("Amesos_Klu", problem))
    {
    }

    std::unique_ptr<PointMatrix>       matrix;
    Epetra_Vector                      x, b;
    Epetra_LinearProblem               problem;
    std::unique_ptr<Amesos_BaseSolver> solver;
  };

  DirectSolver::DirectSolver(const mechanics::BlockMatrix       &matrix,
                             const mechanics::DisplacementSpace &space)
    : factors(std::make_unique<Factors>(matrix, space))
  {
    if (factors->solver == nullptr || factors->solver->SymbolicFactorization() != 0
        || factors->solver->NumericFactorization() != 0)
      throw_singular();
  }

  DirectSolver::~DirectSolver() = default;

  void
  DirectSolver::solve(const mechanics::Vector &right_hand_side, mechanics::Vector &solution) const
  {
    const std::size_t n = right_hand_side.locally_owned_size();
    std::copy(right_hand_side.begin(), right_hand_side.begin() + n, factors->b.Values());
    if (factors->solver->Solve() != 0)
      throw_singular();
    std::copy(factors->x.Values(), factors->x.Values() + n, solution.begin());
  }
} // namespace tetradapt::solve
