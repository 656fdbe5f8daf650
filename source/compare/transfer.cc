// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/transfer.h"

namespace tetradapt::compare
{
  mesh::NodalField
  interpolate(const mesh::NodalField              &field,
              const PointLocator                  &locator,
              std::shared_ptr<const mesh::TetMesh> new_mesh)
  {
    mesh::NodalField      result(std::move(new_mesh), field.degree());
    std::vector<Point<3>> nodes(result.n_nodes());
    for (unsigned int n = 0; n < nodes.size(); ++n)
      nodes[n] = result.node_position(n);
    const std::vector<Location> locations = locator.locate(nodes);
    for (unsigned int n = 0; n < nodes.size(); ++n)
      result.values[n] = field.value(locations[n].cell, locations[n].barycentric);
    if (field.pressure)
      {
        const auto pressure = std::make_shared<mesh::PressureField>(result.mesh());
        for (unsigned int n = 0; n < pressure->values.size(); ++n)
          {
            const Location &at  = locations[pressure->nodes->vertex(n)];
            pressure->values[n] = field.pressure->value(at.cell, at.barycentric);
          }
        result.pressure = pressure;
      }
    return result;
  }
} // namespace tetradapt::compare
