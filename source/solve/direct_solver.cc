// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/direct_solver.h"

#include "tetradapt/core/exceptions.h"

#include "messages.h"

#include <deal.II/base/mpi.h>

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

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

    /** Columns of the upper triangle, in the order of the unknowns' global numbers. */
    struct Triangle
    {
      std::vector<std::int64_t> lengths, rows;
      std::vector<double>       values;
    };

    /** The columns of this rank's unknowns: as the matrix is symmetric, its rows. */
    Triangle
    own_columns(const mechanics::BlockMatrix &matrix)
    {
      Triangle    triangle;
      const auto &layout = *matrix.vector_layout();
      for (unsigned int row = 0; row < 3 * matrix.n_rows(); ++row)
        {
          const std::size_t before = triangle.rows.size();
          const auto        number = layout.local_to_global(row);
          for (std::size_t k = matrix.row_begin(row / 3); k < matrix.row_end(row / 3); ++k)
            for (unsigned int j = 0; j < 3; ++j)
              {
                const auto   column = layout.local_to_global(3 * matrix.column(k) + j);
                const double value  = matrix.block(k)[3 * (row % 3) + j];
                if (column == number || (column < number && value != 0.))
                  {
                    triangle.rows.push_back(static_cast<std::int64_t>(column));
                    triangle.values.push_back(value);
                  }
              }
          triangle.lengths.push_back(static_cast<std::int64_t>(triangle.rows.size() - before));
        }
      return triangle;
    }

    /** All columns. Collective. */
    Triangle
    gather(Triangle triangle, MPI_Comm communicator)
    {
      if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
        return triangle;
      return {all_gather_values(triangle.lengths, communicator),
              all_gather_values(triangle.rows, communicator),
              all_gather_values(triangle.values, communicator)};
    }
  } // namespace

  struct DirectSolver::Factors
  {
    Factors()
    {
      cholmod_l_start(&common);
      common.print = 0; // no messages of its own
    }
    ~Factors()
    {
      cholmod_l_free_factor(&factor, &common);
      cholmod_l_finish(&common);
    }

    /** Factorises; false if it is not positive definite. */
    bool
    factorise(const Triangle &triangle)
    {
      const std::size_t n      = triangle.lengths.size();
      cholmod_sparse   *matrix = cholmod_l_allocate_sparse(
        n, n, triangle.rows.size(), /*sorted*/ 0, /*packed*/ 1, /*upper*/ 1, CHOLMOD_REAL, &common);
      if (matrix == nullptr)
        return false;
      auto *begin = static_cast<std::int64_t *>(matrix->p);
      begin[0]    = 0;
      std::partial_sum(triangle.lengths.begin(), triangle.lengths.end(), begin + 1);
      std::copy(triangle.rows.begin(), triangle.rows.end(), static_cast<std::int64_t *>(matrix->i));
      std::copy(triangle.values.begin(), triangle.values.end(), static_cast<double *>(matrix->x));
      factor = cholmod_l_analyze(matrix, &common);
      if (factor != nullptr)
        cholmod_l_factorize(matrix, factor, &common);
      cholmod_l_free_sparse(&matrix, &common);
      return factor != nullptr && common.status == CHOLMOD_OK && factor->minor == n;
    }

    /** x becomes the solution for the right-hand side x; false without memory. */
    bool
    solve(std::vector<double> &x)
    {
      cholmod_dense *b = cholmod_l_allocate_dense(x.size(), 1, x.size(), CHOLMOD_REAL, &common);
      if (b == nullptr)
        return false;
      std::copy(x.begin(), x.end(), static_cast<double *>(b->x));
      cholmod_dense *solution = cholmod_l_solve(CHOLMOD_A, factor, b, &common);
      const bool     solved   = solution != nullptr;
      if (solved)
        std::copy_n(static_cast<const double *>(solution->x), x.size(), x.begin());
      cholmod_l_free_dense(&solution, &common);
      cholmod_l_free_dense(&b, &common);
      return solved;
    }

    cholmod_common  common;
    cholmod_factor *factor = nullptr;
  };

  DirectSolver::DirectSolver(const mechanics::BlockMatrix       &matrix,
                             const mechanics::DisplacementSpace &space)
    : factors(std::make_unique<Factors>()), communicator(space.communicator()),
      is_first_rank(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    const Triangle triangle = gather(own_columns(matrix), communicator);
    const bool     good     = !is_first_rank || factors->factorise(triangle);
    if (dealii::Utilities::MPI::min(good ? 1 : 0, communicator) == 0)
      throw_singular();
  }

  DirectSolver::~DirectSolver() = default;

  void
  DirectSolver::solve(const mechanics::Vector &right_hand_side, mechanics::Vector &solution) const
  {
    const std::size_t         n = right_hand_side.locally_owned_size();
    const std::vector<double> own(right_hand_side.begin(), right_hand_side.begin() + n);
    std::vector<double>       x    = all_gather_values(own, communicator);
    const bool                good = !is_first_rank || factors->solve(x);
    if (dealii::Utilities::MPI::min(good ? 1 : 0, communicator) == 0)
      throw_singular();
    MPI_Bcast(x.data(), static_cast<int>(x.size()), MPI_DOUBLE, 0, communicator);
    const auto first = right_hand_side.get_partitioner()->local_range().first;
    std::copy_n(x.begin() + first, n, solution.begin());
  }
} // namespace tetradapt::solve
