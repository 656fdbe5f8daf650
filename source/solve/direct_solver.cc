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
  void
  solve_directly(const mechanics::BlockMatrix       &matrix,
                 const mechanics::DisplacementSpace &space,
                 const Vector                       &right_hand_side,
                 Vector                             &solution)
  {
    const auto        point_matrix = to_point_matrix(matrix, space);
    Epetra_Vector     x(point_matrix->RowMap()), b(point_matrix->RowMap());
    const std::size_t n = right_hand_side.locally_owned_size();
    std::copy(right_hand_side.begin(), right_hand_side.begin() + n, b.Values());

    Epetra_LinearProblem                     problem(point_matrix.get(), &x, &b);
    const std::unique_ptr<Amesos_BaseSolver> solver(Amesos().Create("Amesos_Klu", problem));
    if (solver == nullptr || solver->SymbolicFactorization() != 0
        || solver->NumericFactorization() != 0 || solver->Solve() != 0)
      throw core::NumericalError(
        "The direct solver could not factorise the stiffness matrix: it is singular to rounding. "
        "Look for elements with almost no volume, or set Solver/Type = cg.");
    std::copy(x.Values(), x.Values() + n, solution.begin());
  }
} // namespace tetradapt::solve
