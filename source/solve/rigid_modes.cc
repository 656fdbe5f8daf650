// SPDX-License-Identifier: AGPL-3.0-or-later
#include "rigid_modes.h"

#include "tetradapt/mechanics/rigid_motions.h"

namespace tetradapt::solve
{
  dealii::Point<3>
  position(const fem::Space &space, const unsigned int node)
  {
    const auto        &points     = space.tet_mesh().points;
    const unsigned int field_node = space.field_node(node);
    if (field_node < points.size())
      return points[field_node];
    const auto &edge = space.edge_table()->edges[field_node - points.size()];
    return points[edge[0]] + 0.5 * (points[edge[1]] - points[edge[0]]);
  }

  std::vector<NodeModes<3>>
  rigid_modes(const fem::Space &space, const fem::FixedUnknowns &fixed)
  {
    const auto                box    = mesh::bounding_box(space.tet_mesh());
    const auto                centre = box.first + 0.5 * (box.second - box.first);
    const double              length = 0.5 * (box.second - box.first).norm();
    std::vector<NodeModes<3>> modes(space.n_owned_nodes());
    for (unsigned int node = 0; node < modes.size(); ++node)
      {
        const auto x = position(space, node);
        for (unsigned int k = 0; k < 6; ++k)
          {
            const auto motion
              = fixed.free_part(node, mechanics::rigid_motion(k, x, centre, length));
            for (unsigned int c = 0; c < 3; ++c)
              modes[node][6 * c + k] = motion[c];
          }
      }
    return modes;
  }
} // namespace tetradapt::solve
