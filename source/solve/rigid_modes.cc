// SPDX-License-Identifier: AGPL-3.0-or-later
#include "rigid_modes.h"

#include "tetradapt/mechanics/rigid_motions.h"

namespace tetradapt::solve
{
  std::vector<NodeModes<3>>
  rigid_modes(const fem::Space &space, const fem::FixedUnknowns &fixed)
  {
    const auto                box    = mesh::bounding_box(space.tet_mesh());
    const auto                centre = box.first + 0.5 * (box.second - box.first);
    const double              length = 0.5 * (box.second - box.first).norm();
    std::vector<NodeModes<3>> modes(space.n_owned_nodes());
    for (unsigned int node = 0; node < modes.size(); ++node)
      {
        const auto x = space.node_position(node);
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
