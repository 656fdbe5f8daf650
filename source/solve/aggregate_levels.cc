// SPDX-License-Identifier: AGPL-3.0-or-later
#include "aggregate_levels.h"

namespace tetradapt::solve
{
  namespace
  {
    constexpr unsigned int max_coarse_rows = 60; ///< aggregates that a dense matrix is made for
    /** How many times fewer nodes are worth a level. */
    constexpr double least_reduction = 2.;
  } // namespace

  AggregateLevels::AggregateLevels(CoarseMatrix matrix, const LevelRule &rule)
  {
    while (matrix.n_nodes > max_coarse_rows)
      {
        levels.push_back(
          std::make_unique<Level<double, 6>>(matrix.rows, matrix.layout, rule.smoother_degree));
        Level<double, 6>   &level = *levels.back();
        std::vector<double> omegas(levels.size() == 1 ? rule.first_damping : rule.damping);
        for (double &omega : omegas)
          omega /= level.smoother.largest_eigenvalue();
        auto coarsening = coarsen(matrix.rows,
                                  matrix.modes,
                                  matrix.layout,
                                  rule.aggregate(matrix.rows),
                                  omegas,
                                  least_reduction);
        if (!coarsening)
          return; // nothing gained by going on: the smoother has to do
        level.prolongation = Prolongation<double, 6>(coarsening->prolongation);
        matrix             = std::move(coarsening->coarse);
      }
    bottom = std::make_unique<DenseCholesky>(matrix.rows);
    bottom_values.reinit(matrix.layout);
  }

  void
  AggregateLevels::add_up(VectorOf<double>                          &forces,
                          const dealii::Utilities::MPI::Partitioner &from) const
  {
    if (forces.get_partitioner()->n_mpi_processes() > 1)
      forces.compress(dealii::VectorOperation::add);
    else if (from.n_mpi_processes() > 1)
      MPI_Allreduce(MPI_IN_PLACE,
                    forces.begin(),
                    static_cast<int>(forces.size()),
                    MPI_DOUBLE,
                    MPI_SUM,
                    from.get_mpi_communicator());
  }

  void
  AggregateLevels::cycle(std::size_t i, VectorOf<double> &x, const VectorOf<double> &b) const
  {
    const Level<double, 6> &level = *levels[i];
    level.smoother.start(x, b);
    if (i + 1 < levels.size() || bottom != nullptr)
      {
        level.matrix.vmult(level.residual, x);
        level.residual.sadd(-1, 1, b);
        correct_from(level.prolongation, i + 1, level.residual, x);
      }
    level.smoother.step(x, b);
  }

  const VectorOf<double> &
  AggregateLevels::solve(std::size_t i) const
  {
    if (i == levels.size())
      {
        bottom->solve(bottom_values.begin());
        return bottom_values;
      }
    const Level<double, 6> &level = *levels[i];
    cycle(i, level.solution, level.right_hand_side);
    if (i == 0)
      return level.solution;
    level.matrix.vmult(level.residual, level.solution);
    level.right_hand_side -= level.residual;
    cycle(i, level.correction, level.right_hand_side);
    level.solution += level.correction;
    return level.solution;
  }
} // namespace tetradapt::solve
