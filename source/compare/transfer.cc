// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/transfer.h"

#include "tetradapt/mesh/edges.h"

namespace tetradapt::compare
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    /**
     * For every node of @p result the node of @p field that is at the same place, as far as
     * that shows without a search: TetGen keeps the points of a mesh that it refines and their
     * numbers, and many of its edges.
     */
    std::vector<unsigned int>
    kept_nodes(const mesh::NodalField &field, const mesh::NodalField &result)
    {
      const auto               &before = field.mesh().points, &now = result.mesh().points;
      std::vector<unsigned int> kept(result.n_nodes(), none);
      bool                      any = false;
      for (unsigned int n = 0; n < std::min(before.size(), now.size()); ++n)
        if (before[n] == now[n])
          {
            kept[n] = n;
            any     = true;
          }
      if (!any || result.degree() == 1)
        return kept;
      const mesh::EdgeFinder finder(field.edges(), before.size());
      const auto            &edges = result.edges().edges;
      for (unsigned int e = 0; e < edges.size(); ++e)
        if (kept[edges[e][0]] != none && kept[edges[e][1]] != none)
          if (const unsigned int edge = finder.find(edges[e][0], edges[e][1]); edge != none)
            kept[now.size() + e] = before.size() + edge;
      return kept;
    }
  } // namespace

  mesh::NodalField
  interpolate(const mesh::NodalField              &field,
              const PointLocator                  &locator,
              std::shared_ptr<const mesh::TetMesh> new_mesh)
  {
    mesh::NodalField          result(std::move(new_mesh), field.degree());
    const auto                kept = kept_nodes(field, result);
    std::vector<unsigned int> nodes; // that have to be located
    std::vector<Point<3>>     positions;
    for (unsigned int n = 0; n < result.n_nodes(); ++n)
      if (kept[n] != none)
        result.values[n] = field.values[kept[n]];
      else
        {
          nodes.push_back(n);
          positions.push_back(result.node_position(n));
        }
    const std::vector<Location> locations = locator.locate(positions);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      result.values[nodes[i]] = field.value(locations[i].cell, locations[i].barycentric);
    if (field.pressure)
      {
        const auto            pressure = std::make_shared<mesh::PressureField>(result.mesh());
        std::vector<Point<3>> vertices(pressure->values.size());
        for (unsigned int n = 0; n < vertices.size(); ++n)
          vertices[n] = result.mesh().points[pressure->nodes->vertex(n)];
        const std::vector<Location> at = locator.locate(vertices);
        for (unsigned int n = 0; n < vertices.size(); ++n)
          pressure->values[n] = field.pressure->value(at[n].cell, at[n].barycentric);
        result.pressure = pressure;
      }
    return result;
  }
} // namespace tetradapt::compare
