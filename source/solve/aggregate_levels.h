// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_aggregate_levels_h
#define tetradapt_source_solve_aggregate_levels_h

#include "tetradapt/solve/chebyshev.h"

#include "coarsening.h"
#include "dense_cholesky.h"

#include <algorithm>
#include <functional>
#include <memory>

namespace tetradapt::solve
{
  /** The rows of the owned nodes, each with six unknowns of aggregates a block. */
  template <typename Number, unsigned int n>
  class Prolongation
  {
  public:
    Prolongation() = default;
    explicit Prolongation(const BlockRows<n, 6> &rows)
      : begin(rows.begin), columns(rows.columns), blocks(rows.blocks.size())
    {
      for (std::size_t k = 0; k < blocks.size(); ++k)
        std::copy(rows.blocks[k].begin(), rows.blocks[k].end(), blocks[k].begin());
    }

    /** fine += P coarse. */
    void
    add(Number *fine, const double *coarse) const
    {
      for (std::size_t row = 0; row + 1 < begin.size(); ++row, fine += n)
        for (std::size_t k = begin[row]; k < begin[row + 1]; ++k)
          {
            Number x[6];
            std::copy_n(coarse + 6 * std::size_t(columns[k]), 6, x);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < 6; ++j)
                fine[i] += blocks[k][6 * i + j] * x[j];
          }
    }

    /** coarse += P^T fine. */
    void
    add_transposed(double *coarse, const Number *fine) const
    {
      for (std::size_t row = 0; row + 1 < begin.size(); ++row, fine += n)
        for (std::size_t k = begin[row]; k < begin[row + 1]; ++k)
          {
            Number sums[6] = {};
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < 6; ++j)
                sums[j] += blocks[k][6 * i + j] * fine[i];
            double *x = coarse + 6 * std::size_t(columns[k]);
            for (unsigned int j = 0; j < 6; ++j)
              x[j] += sums[j];
          }
    }

  private:
    std::vector<std::size_t>               begin{0};
    std::vector<unsigned int>              columns;
    std::vector<std::array<Number, 6 * n>> blocks;
  };

  /** A level with n unknowns a node; @p degree is that of its smoother, which leaves what
   * @p aggregates couple alone, if these are not null. */
  template <typename Number, unsigned int n>
  struct Level
  {
    Level(const BlockRows<n, n> &rows,
          const Layout          &layout,
          unsigned int           degree,
          double                 scale      = 1.,
          const RigidAggregates *aggregates = nullptr)
      : matrix(rows, layout, scale),
        smoother(matrix,
                 without(aggregates, invert_blocks<Number, n>(matrix.diagonal_blocks())),
                 degree),
        residual(layout)
    {
      if (n == 6)
        for (auto *vector : {&solution, &correction, &right_hand_side})
          vector->reinit(layout);
    }

    BlockOperator<Number, n>     matrix;
    ChebyshevSmoother<Number, n> smoother;
    Prolongation<Number, n>      prolongation; ///< from the level below
    mutable VectorOf<Number>     residual;
    mutable VectorOf<Number>     solution, correction, right_hand_side; ///< not on the finest
  };

  /** How a level of aggregates is smoothed and coarsened. */
  struct LevelRule
  {
    std::function<Aggregates(const BlockRows<6, 6> &)> aggregate;
    /** The factors of the prolongations, see coarsen(), in units of the inverse of the
     * largest eigenvalue: to the first of these levels, and to the others. */
    std::vector<double> first_damping, damping;
    unsigned int        smoother_degree;
  };

  /**
   * Multigrid for a matrix whose nodes are aggregates. Levels are distributed like their
   * matrices while they have enough nodes a rank, and on every rank from there on. They are in
   * double precision always: where a stiff part hangs on a soft one, rounding its coarse matrix
   * would outweigh what holds it.
   */
  class AggregateLevels
  {
  public:
    /** Collective. */
    AggregateLevels(CoarseMatrix matrix, const LevelRule &rule);

    /** x += P B P^T residual, with B one cycle. Collective. */
    template <typename Number, unsigned int n>
    void
    correct(const Prolongation<Number, n> &prolongation,
            const VectorOf<Number>        &residual,
            VectorOf<Number>              &x) const
    {
      correct_from(prolongation, 0, residual, x);
    }

  private:
    /** correct() with the levels from @p next on. */
    template <typename Number, unsigned int n>
    void
    correct_from(const Prolongation<Number, n> &prolongation,
                 std::size_t                    next,
                 const VectorOf<Number>        &residual,
                 VectorOf<Number>              &x) const
    {
      if (next == levels.size() && bottom == nullptr)
        return;
      VectorOf<double> &forces
        = next < levels.size() ? levels[next]->right_hand_side : bottom_values;
      forces = 0.;
      prolongation.add_transposed(forces.begin(), residual.begin());
      add_up(forces, *residual.get_partitioner());
      const VectorOf<double> &correction = solve(next);
      correction.update_ghost_values();
      prolongation.add(x.begin(), correction.begin());
      correction.zero_out_ghost_values();
    }
    /** Sums forces to which the ranks of the finer level @p from have added their parts. */
    void
    add_up(VectorOf<double> &forces, const dealii::Utilities::MPI::Partitioner &from) const;
    /** x = about A^-1 b on a level. */
    void
    cycle(std::size_t i, VectorOf<double> &x, const VectorOf<double> &b) const;
    /** The correction for the right-hand side that is stored with level @p i. Two cycles
     * from the second on, where they cost little (a W-cycle). */
    const VectorOf<double> &
    solve(std::size_t i) const;

    std::vector<std::unique_ptr<Level<double, 6>>> levels;
    std::unique_ptr<DenseCholesky>                 bottom;
    mutable VectorOf<double>                       bottom_values;
  };
} // namespace tetradapt::solve

#endif
