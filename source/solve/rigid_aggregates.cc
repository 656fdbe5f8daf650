// SPDX-License-Identifier: AGPL-3.0-or-later
#include "rigid_aggregates.h"

#include "tetradapt/mechanics/rigid_motions.h"

#include <deal.II/base/mpi.h>

namespace tetradapt::solve
{
  namespace
  {
    /** The rigid motions that rigid_modes() has, in the columns of a coupling. */
    NodeModes<6>
    modes_of(const mechanics::RigidCoupling &coupling, const fem::Space &space)
    {
      const auto   box    = mesh::bounding_box(space.tet_mesh());
      const auto   centre = box.first + 0.5 * (box.second - box.first);
      const double length = 0.5 * (box.second - box.first).norm();
      NodeModes<6> modes{};
      for (const auto &x : coupling.positions)
        for (unsigned int k = 0; k < coupling.basis.size(); ++k)
          {
            const auto column = mechanics::displacement(coupling.basis[k], x - coupling.reference);
            for (unsigned int j = 0; j < 6; ++j)
              modes[6 * k + j] += column * mechanics::rigid_motion(j, x, centre, length);
          }
      return modes;
    }
  } // namespace

  RigidAggregates::RigidAggregates(const mechanics::RigidCouplings &couplings,
                                   const fem::Space                &space)
    : n_local_nodes(space.n_local_nodes())
  {
    const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(space.communicator());
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(space.communicator());
    std::vector<unsigned int> number; // among those with free motions, of all couplings
    std::vector<const mechanics::RigidCoupling *> free;
    for (const auto &coupling : couplings.all())
      {
        number.push_back(free.size());
        if (!coupling.basis.empty())
          free.push_back(&coupling);
      }
    // The rank that owns the first node.
    for (const auto *coupling : free)
      owner.push_back(space.local_node(coupling->nodes.front()) < space.n_owned_nodes() ? rank : 0);
    dealii::Utilities::MPI::max(owner, space.communicator(), owner);
    place.resize(free.size());
    std::vector<unsigned int> count(n_ranks, 0);
    for (std::size_t c = free.size(); c-- > 0;)
      place[c] = ++count[owner[c]];
    for (std::size_t c = 0; c < free.size(); ++c)
      if (owner[c] == rank)
        coarse_modes.push_back(modes_of(*free[c], space));
    for (const auto &node : couplings.nodes())
      {
        local_nodes.push_back(node.local);
        aggregate_of.push_back(number[node.coupling]);
        NodeModes<3> row{};
        for (unsigned int k = 0; k < couplings.all()[node.coupling].basis.size(); ++k)
          {
            const auto column = couplings.column(node, k);
            for (unsigned int c = 0; c < 3; ++c)
              row[6 * c + k] = column[c];
          }
        rows.push_back(row);
      }
  }

  void
  RigidAggregates::add_to(LocalTentative<3>               &tentative,
                          const std::vector<unsigned int> &firsts) const
  {
    for (std::size_t i = 0; i < local_nodes.size(); ++i)
      {
        const unsigned int c                 = aggregate_of[i];
        tentative.aggregates[local_nodes[i]] = firsts[owner[c] + 1] - place[c];
        tentative.rows[local_nodes[i]]       = rows[i];
      }
  }

  BlockRows<3, 3>
  RigidAggregates::without_couplings(const BlockRows<3, 3> &matrix) const
  {
    std::vector<unsigned char> is_coupled(n_local_nodes, 0);
    for (const unsigned int node : local_nodes)
      is_coupled[node] = 1;
    BlockRows<3, 3> result = matrix;
    for (unsigned int row = 0; row < result.n_rows(); ++row)
      for (std::size_t k = result.begin[row]; k < result.begin[row + 1]; ++k)
        if (result.columns[k] != row
            && (is_coupled[row] != 0 || is_coupled[result.columns[k]] != 0))
          result.blocks[k].fill(0.);
    return result;
  }
} // namespace tetradapt::solve
