// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_rigid_aggregates_h
#define tetradapt_source_solve_rigid_aggregates_h

#include "tetradapt/mechanics/rigid_coupling.h"
#include "tetradapt/solve/galerkin.h"

namespace tetradapt::solve
{
  /**
   * The nodes that move with a reference point, as an aggregate for each of these, whatever ranks
   * have the nodes: its unknowns are the free motions of the reference point, and it prolongates
   * exactly to them.
   *
   * A smoother must leave these nodes alone, see without(): what is coupled is corrected from the
   * coarser level only.
   */
  class RigidAggregates
  {
  public:
    /** Collective. @p couplings are of the nodes of @p space. */
    RigidAggregates(const mechanics::RigidCouplings &couplings, const fem::Space &space);

    /** How many of the aggregates belong to this rank. */
    unsigned int
    n_owned() const
    {
      return coarse_modes.size();
    }
    /** The rigid motions of the body in the unknowns of those. */
    const std::vector<NodeModes<6>> &
    modes() const
    {
      return coarse_modes;
    }
    /** The nodes, ghosts included, of the space. */
    const std::vector<unsigned int> &
    nodes() const
    {
      return local_nodes;
    }
    /** Puts the nodes into their aggregates, which come last on their ranks.
     * @param firsts are the numbers of the aggregates of each rank, then of all. */
    void
    add_to(LocalTentative<3> &tentative, const std::vector<unsigned int> &firsts) const;

    /** @p rows with zeros in the place of all blocks between coupled and other nodes. */
    BlockRows<3, 3>
    without_couplings(const BlockRows<3, 3> &rows) const;

  private:
    std::vector<unsigned int> local_nodes, aggregate_of; ///< the aggregate of each node
    std::vector<NodeModes<3>> rows;                      ///< and its motions
    std::vector<unsigned int> owner, place; ///< rank of each aggregate, and from its last one back
    std::vector<NodeModes<6>> coarse_modes;
    unsigned int              n_local_nodes;
  };

  /** @p blocks with zeros at the nodes of @p aggregates, if these are not null. */
  template <typename Block>
  std::vector<Block>
  without(const RigidAggregates *aggregates, std::vector<Block> blocks)
  {
    if (aggregates != nullptr)
      for (const unsigned int node : aggregates->nodes())
        if (node < blocks.size())
          blocks[node].fill(0);
    return blocks;
  }
} // namespace tetradapt::solve

#endif
