// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_node_exchange_h
#define tetradapt_source_solve_node_exchange_h

#include "tetradapt/solve/galerkin.h"

namespace tetradapt::solve
{
  using Layout = std::shared_ptr<const dealii::Utilities::MPI::Partitioner>;

  /** The first number of each rank where those of all ranks are numbered rank by rank; then
   * how many there are. Collective. */
  std::vector<unsigned int>
  first_numbers(unsigned int own_count, const Layout &layout);

  /** Numbers the aggregates of all ranks rank by rank, and fetches those of ghost nodes
   * with their rows. @p first is the number of this rank's first one. Collective. */
  template <unsigned int n>
  LocalTentative<n>
  with_ghosts(const Aggregates                &aggregates,
              const std::vector<NodeModes<n>> &rows,
              unsigned int                     first,
              const Layout                    &layout);

  /** Appends the rows of ghost nodes. Collective. */
  template <unsigned int n>
  void
  append_ghost_rows(BlockRows<n, 6> &prolongation, const Layout &layout);

  /** The sum of the matrices of all ranks, on every rank. Collective. */
  BlockRows<6, 6>
  sum_over_ranks(const BlockRows<6, 6> &matrix, MPI_Comm communicator);

  /** Of the sum of the matrices of all ranks, the rows of this rank: from @p firsts[rank] to
   * before @p firsts[rank + 1]. Collective. */
  BlockRows<6, 6>
  sum_own_rows(const BlockRows<6, 6>           &matrix,
               const std::vector<unsigned int> &firsts,
               MPI_Comm                         communicator);

  /** The modes of all ranks' aggregates, on every rank. Collective. */
  std::vector<NodeModes<6>>
  gather_modes(const std::vector<NodeModes<6>> &modes, MPI_Comm communicator);
} // namespace tetradapt::solve

#endif
