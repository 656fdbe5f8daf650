// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_flat_nodes_h
#define tetradapt_solve_flat_nodes_h

#include "tetradapt/solve/aggregation.h"

namespace tetradapt::solve
{
  /** The nodes of a space of degree 2 whose cells are flat or long. */
  struct FlatNodes
  {
    bool exist         = false; ///< on any rank
    bool are_very_flat = false; ///< on the average over all ranks
    /** Cells are flat at most of the nodes, and on the average clearly so. */
    bool are_dominant = false;
    /** How far clusters reach from each owned node: a part of the longest edge there; zero
     * where cells are neither flat nor long. Empty if there are no such nodes. */
    std::vector<double> reach;
  };

  /**
   * Finds flat and long cells by the tensor M = sum e e^T over the edges e of the cells
   * around a vertex: 27 det M / (tr M)^3 is 1 where edges go all ways alike and .5 in cubes cut
   * into six, and falls with the square of the ratio of length to thickness in flat cells, with
   * its fourth power in long ones. Single flat cells among others do not count. Cells
   * near flat ones are taken with them. Collective.
   */
  FlatNodes
  find_flat_nodes(const fem::Space &space);

  /**
   * Sets of flat nodes that are within each other's reach and coupled: in a plate, the nodes
   * above each other. Other nodes get no aggregate.
   * @param matrix is that of the space.
   */
  Aggregates
  cluster(const FlatNodes &flat, const fem::Space &space, const BlockRows<3, 3> &matrix);
} // namespace tetradapt::solve

#endif
