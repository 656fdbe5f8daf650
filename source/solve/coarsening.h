// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_coarsening_h
#define tetradapt_source_solve_coarsening_h

#include "node_exchange.h"
#include "rigid_aggregates.h"

#include <optional>

namespace tetradapt::solve
{
  /** The matrix of a level of smoothed aggregation, and what the next one is made from. A
   * layout of one process among several ranks: every rank holds all of it. */
  struct CoarseMatrix
  {
    BlockRows<6, 6>           rows; ///< columns are local nodes of the layout
    Layout                    layout;
    std::vector<NodeModes<6>> modes;       ///< of the owned nodes: the rigid motions
    unsigned int              n_nodes = 0; ///< over all ranks
  };

  template <unsigned int n>
  struct Coarsening
  {
    BlockRows<n, 6> prolongation; ///< rows of the owned nodes, columns of the coarse layout
    CoarseMatrix    coarse;
  };

  /**
   * The next coarser matrix by smoothed aggregation: the level stays distributed while it
   * has enough nodes a rank to be worth messages, and is on every rank from there on.
   * Collective.
   *
   * @param modes are the rigid motions at the owned nodes.
   * @param aggregates are sets of the owned nodes.
   * @param omegas smooth the prolongation, one factor after the other:
   *        P = ... (1 - omegas[1] D^-1 A) (1 - omegas[0] D^-1 A) T. None: P = T.
   * @param rigid if not null, are further aggregates, of nodes that are in none of @p aggregates;
   *        their part of the prolongation is not smoothed.
   * @param least_reduction is how many times fewer nodes are worth a level.
   * @return nothing if the reduction is less, or if there is nothing to be corrected.
   */
  template <unsigned int n>
  std::optional<Coarsening<n>>
  coarsen(const BlockRows<n, n>           &matrix,
          const std::vector<NodeModes<n>> &modes,
          const Layout                    &layout,
          const Aggregates                &aggregates,
          const std::vector<double>       &omegas,
          double                           least_reduction,
          const RigidAggregates           *rigid = nullptr);
} // namespace tetradapt::solve

#endif
