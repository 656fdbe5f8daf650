// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/direct_solver.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/solve/indefinite_matrix.h"

#include "messages.h"

#include <deal.II/base/mpi.h>

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace tetradapt::solve
{
  namespace
  {
    /** Smallest pivot, relative to its diagonal entry, of a matrix that is not singular to
     * rounding. A body that is free to move has one of a few times 1e-16; a softness of
     * 1e-12 times the rest of the body, or a body 1 000 times longer than thick, keep more. */
    constexpr double smallest_pivot = 1e-14;

    [[noreturn]] void
    throw_singular()
    {
      throw core::NumericalError(
        "The direct solver could not factorise the stiffness matrix: it is singular to rounding. "
        "Either a part of the body is free to move, or there are elements with almost no volume, "
        "or materials of very different stiffness. Add a support, or repair the mesh.");
    }

    [[noreturn]] void
    throw_out_of_memory()
    {
      throw core::NumericalError("The direct solver has not enough memory to factorise the "
                                 "stiffness matrix. Set Solver/Type = cg, or choose a coarser "
                                 "mesh.");
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

    /** All columns, on the first rank. Collective. */
    Triangle
    gather(Triangle triangle, MPI_Comm communicator)
    {
      if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
        return triangle;
      const Shares columns(triangle.lengths.size(), communicator);
      const Shares entries(triangle.rows.size(), communicator);
      return {gather_values(triangle.lengths, columns, communicator),
              gather_values(triangle.rows, entries, communicator),
              gather_values(triangle.values, entries, communicator)};
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

    /** Factorises the matrix with its diagonal scaled to ones, so that pivots tell how many
     * digits are left in any units. False if it is not positive definite to rounding. */
    bool
    factorise(const Triangle &triangle)
    {
      const std::size_t n = triangle.lengths.size();
      if (!find_scales(triangle))
        return false;
      cholmod_sparse *matrix = cholmod_l_allocate_sparse(
        n, n, triangle.rows.size(), /*sorted*/ 0, /*packed*/ 1, /*upper*/ 1, CHOLMOD_REAL, &common);
      if (matrix == nullptr)
        return false;
      auto *begin = static_cast<std::int64_t *>(matrix->p);
      begin[0]    = 0;
      std::partial_sum(triangle.lengths.begin(), triangle.lengths.end(), begin + 1);
      std::copy(triangle.rows.begin(), triangle.rows.end(), static_cast<std::int64_t *>(matrix->i));
      auto *values = static_cast<double *>(matrix->x);
      for (std::size_t column = 0, k = 0; column < n; ++column)
        for (; k < static_cast<std::size_t>(begin[column + 1]); ++k)
          values[k] = triangle.values[k] * scales[column] * scales[triangle.rows[k]];
      factor = cholmod_l_analyze(matrix, &common);
      if (factor != nullptr)
        cholmod_l_factorize(matrix, factor, &common);
      cholmod_l_free_sparse(&matrix, &common);
      // The largest pivot is one, so this is the smallest. False for NaN.
      return factor != nullptr && common.status == CHOLMOD_OK && factor->minor == n
             && cholmod_l_rcond(factor, &common) > smallest_pivot && has_positive_pivots();
    }

    /** The simplicial factorisation L D L^T goes on where an entry of D is negative. */
    bool
    has_positive_pivots() const
    {
      if (factor->is_super != 0 || factor->is_ll != 0)
        return true; // L L^T ends there
      const auto *begin  = static_cast<const std::int64_t *>(factor->p);
      const auto *values = static_cast<const double *>(factor->x);
      for (std::size_t column = 0; column < factor->n; ++column)
        if (!(values[begin[column]] > 0.))
          return false;
      return true;
    }

    /** x becomes the solution for the right-hand side x; false without memory. */
    bool
    solve(std::vector<double> &x)
    {
      cholmod_dense *b = cholmod_l_allocate_dense(x.size(), 1, x.size(), CHOLMOD_REAL, &common);
      if (b == nullptr)
        return false;
      for (std::size_t i = 0; i < x.size(); ++i)
        static_cast<double *>(b->x)[i] = x[i] * scales[i];
      cholmod_dense *solution = cholmod_l_solve(CHOLMOD_A, factor, b, &common);
      const bool     solved   = solution != nullptr;
      if (solved)
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i] = static_cast<const double *>(solution->x)[i] * scales[i];
      cholmod_l_free_dense(&solution, &common);
      cholmod_l_free_dense(&b, &common);
      return solved;
    }

    /** The inverse roots of the diagonal; false if an entry is not positive. */
    bool
    find_scales(const Triangle &triangle)
    {
      const std::size_t n = triangle.lengths.size();
      scales.assign(n, 0.);
      for (std::size_t column = 0, k = 0; column < n; ++column)
        for (std::int64_t i = 0; i < triangle.lengths[column]; ++i, ++k)
          if (triangle.rows[k] == static_cast<std::int64_t>(column) && triangle.values[k] > 0.)
            scales[column] = 1. / std::sqrt(triangle.values[k]);
      return std::all_of(scales.begin(), scales.end(), [](const double s) {
        return s > 0. && std::isfinite(s);
      });
    }

    cholmod_common      common;
    cholmod_factor     *factor = nullptr;
    std::vector<double> scales;
  };

  DirectSolver::DirectSolver(const mechanics::BlockMatrix &matrix,
                             const fem::Space             &space,
                             const bool                    may_be_indefinite)
    : factors(std::make_unique<Factors>()), communicator(space.communicator()),
      is_first_rank(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    const Triangle triangle = gather(own_columns(matrix), communicator);
    bool           good     = !is_first_rank || factors->factorise(triangle);
    bool           fits     = !is_first_rank || factors->common.status != CHOLMOD_OUT_OF_MEMORY;
    good                    = dealii::Utilities::MPI::min(good ? 1 : 0, communicator) == 1;
    fits                    = dealii::Utilities::MPI::min(fits ? 1 : 0, communicator) == 1;
    if (!fits)
      throw_out_of_memory();
    if (!good && may_be_indefinite)
      throw IndefiniteMatrix();
    if (!good)
      throw_singular();
  }

  DirectSolver::~DirectSolver() = default;

  void
  DirectSolver::solve(const mechanics::Vector &right_hand_side, mechanics::Vector &solution) const
  {
    const std::size_t         n = right_hand_side.locally_owned_size();
    const std::vector<double> own(right_hand_side.begin(), right_hand_side.begin() + n);
    const Shares              shares(n, communicator);
    std::vector<double>       x    = gather_values(own, shares, communicator);
    const bool                good = !is_first_rank || factors->solve(x);
    if (dealii::Utilities::MPI::min(good ? 1 : 0, communicator) == 0)
      throw_out_of_memory();
    MPI_Scatterv(x.data(),
                 shares.sizes.data(),
                 shares.begins.data(),
                 MPI_DOUBLE,
                 solution.begin(),
                 static_cast<int>(n),
                 MPI_DOUBLE,
                 0,
                 communicator);
  }
} // namespace tetradapt::solve
