// SPDX-License-Identifier: AGPL-3.0-or-later
#include "coarsening.h"

#include "tetradapt/solve/chebyshev.h"

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    /** Nodes a rank from which on a level is distributed: their work outweighs messages. */
    constexpr unsigned int least_nodes_of_rank = 200;

    template <unsigned int n>
    std::vector<std::array<double, n * n>>
    inverse_diagonal(const BlockRows<n, n> &matrix)
    {
      std::vector<std::array<double, n * n>> diagonal(matrix.n_rows());
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
          if (matrix.columns[k] == row)
            diagonal[row] = matrix.blocks[k];
      return invert_blocks<double, n>(diagonal);
    }

    /** Unknowns of motions that an aggregate does not have get the mean of the others on
     * the diagonal. */
    void
    fill_empty_rows(BlockRows<6, 6> &matrix)
    {
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
          if (matrix.columns[k] == row)
            {
              auto  &block = matrix.blocks[k];
              double trace = 0.;
              for (unsigned int i = 0; i < 6; ++i)
                trace += std::max(block[7 * i], 0.);
              for (unsigned int i = 0; i < 6; ++i)
                if (!(block[7 * i] > 0.))
                  block[7 * i] = trace > 0. ? trace / 6. : 1.;
            }
    }

    /** Gives a matrix and a prolongation whose columns are numbered over all ranks local
     * columns, and the matrix a layout: ghosts are what either names. */
    template <unsigned int n>
    Layout
    make_local(BlockRows<6, 6>                 &matrix,
               BlockRows<n, 6>                 &prolongation,
               const std::vector<unsigned int> &firsts,
               MPI_Comm                         communicator)
    {
      const unsigned int rank  = dealii::Utilities::MPI::this_mpi_process(communicator);
      const unsigned int begin = firsts[rank], end = firsts[rank + 1], total = firsts.back();
      const auto is_owned = [&](unsigned int column) { return column >= begin && column < end; };
      std::vector<unsigned int> local(total, 0);
      for (const auto *columns : {&matrix.columns, &prolongation.columns})
        for (const unsigned int column : *columns)
          local[column] = 1;
      dealii::IndexSet owned(6 * dealii::types::global_dof_index(total)), ghosts(owned.size());
      owned.add_range(6 * dealii::types::global_dof_index(begin),
                      6 * dealii::types::global_dof_index(end));
      unsigned int next = end - begin;
      for (unsigned int column = 0; column < total; ++column)
        if (is_owned(column))
          local[column] = column - begin;
        else if (local[column] != 0)
          {
            local[column] = next++;
            ghosts.add_range(6 * dealii::types::global_dof_index(column),
                             6 * dealii::types::global_dof_index(column + 1));
          }
      ghosts.compress();
      for (auto *columns : {&matrix.columns, &prolongation.columns})
        for (unsigned int &column : *columns)
          column = local[column];
      return std::make_shared<dealii::Utilities::MPI::Partitioner>(owned, ghosts, communicator);
    }

    /** T itself, of the first @p n_rows nodes. */
    template <unsigned int n>
    BlockRows<n, 6>
    unsmoothed(const LocalTentative<n> &tentative, unsigned int n_rows)
    {
      BlockRows<n, 6> P;
      for (unsigned int row = 0; row < n_rows; ++row)
        {
          if (tentative.aggregates[row] != no_aggregate)
            {
              P.columns.push_back(tentative.aggregates[row]);
              P.blocks.push_back(tentative.rows[row]);
            }
          P.begin.push_back(P.columns.size());
        }
      return P;
    }

    template <unsigned int n>
    void
    keep_rows(BlockRows<n, 6> &matrix, unsigned int n_rows)
    {
      matrix.begin.resize(n_rows + 1);
      matrix.columns.resize(matrix.begin.back());
      matrix.blocks.resize(matrix.begin.back());
    }
  } // namespace

  template <unsigned int n>
  std::optional<Coarsening<n>>
  coarsen(const BlockRows<n, n>           &matrix,
          const std::vector<NodeModes<n>> &modes,
          const Layout                    &layout,
          const Aggregates                &aggregates,
          const std::vector<double>       &omegas,
          const double                     least_reduction,
          const RigidAggregates           *rigid)
  {
    const unsigned int n_rigid = rigid == nullptr ? 0 : rigid->n_owned();
    const auto         firsts  = first_numbers(aggregates.count + n_rigid, layout);
    const unsigned int total   = firsts.back();
    if (total == 0 || least_reduction * total > layout->size() / n)
      return std::nullopt;
    auto           tentative = tentative_prolongation<n>(aggregates, modes);
    const bool     is_shared = layout->n_mpi_processes() > 1;
    const MPI_Comm ranks     = layout->get_mpi_communicator();
    Coarsening<n>  result;
    auto          &P      = result.prolongation;
    CoarseMatrix  &coarse = result.coarse;
    coarse.n_nodes        = total;
    LocalTentative<n> local
      = with_ghosts<n>(aggregates, tentative.rows, firsts[layout->this_mpi_process()], layout);
    if constexpr (n == 3)
      if (rigid != nullptr)
        rigid->add_to(local, firsts);
    const auto inverses = [&]() { return without(rigid, inverse_diagonal(matrix)); };
    if (omegas.empty())
      P = unsmoothed(local, matrix.n_rows());
    else
      P = smooth<n>(matrix, inverses(), local, total, omegas[0]);
    append_ghost_rows(P, layout);
    for (unsigned int k = 1; k < omegas.size(); ++k)
      {
        P = smooth_further<n>(matrix, inverses(), P, total, omegas[k]);
        append_ghost_rows(P, layout);
      }
    coarse.rows  = galerkin(matrix, P, total);
    coarse.modes = std::move(tentative.coarse_modes);
    if (rigid != nullptr)
      coarse.modes.insert(coarse.modes.end(), rigid->modes().begin(), rigid->modes().end());
    keep_rows(P, matrix.n_rows());
    if (is_shared && total >= least_nodes_of_rank * layout->n_mpi_processes())
      {
        coarse.rows   = sum_own_rows(coarse.rows, firsts, ranks);
        coarse.layout = make_local(coarse.rows, P, firsts, ranks);
      }
    else
      {
        if (is_shared)
          {
            coarse.rows  = sum_over_ranks(coarse.rows, ranks);
            coarse.modes = gather_modes(coarse.modes, ranks);
          }
        coarse.layout = std::make_shared<dealii::Utilities::MPI::Partitioner>(6 * total);
      }
    fill_empty_rows(coarse.rows);
    return result;
  }

  template std::optional<Coarsening<3>>
  coarsen(const BlockRows<3, 3> &,
          const std::vector<NodeModes<3>> &,
          const Layout &,
          const Aggregates &,
          const std::vector<double> &,
          double,
          const RigidAggregates *);
  template std::optional<Coarsening<6>>
  coarsen(const BlockRows<6, 6> &,
          const std::vector<NodeModes<6>> &,
          const Layout &,
          const Aggregates &,
          const std::vector<double> &,
          double,
          const RigidAggregates *);
} // namespace tetradapt::solve
