// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/transfer.h"

#include "tetradapt/mesh/edges.h"

namespace tetradapt::compare
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    /**
     * For every owned node of @p space the node of @p field that is at the same place, as far as
     * that shows without a search: TetGen keeps the points of a mesh that it refines and their
     * numbers, and many of its edges.
     */
    std::vector<unsigned int>
    kept_nodes(const mesh::NodalField &field, const fem::Space &space)
    {
      const auto               &before = field.mesh().points, &now = space.tet_mesh().points;
      std::vector<unsigned int> kept(space.n_owned_nodes(), none);
      const auto                is_kept = [&](const unsigned int p) {
        return p < before.size() && p < now.size() && before[p] == now[p];
      };
      std::unique_ptr<mesh::EdgeFinder> finder;
      for (unsigned int n = 0; n < kept.size(); ++n)
        {
          const unsigned int node = space.field_node(n);
          if (node < now.size())
            {
              if (is_kept(node))
                kept[n] = node;
              continue;
            }
          const auto &edge = space.edge_table()->edges[node - now.size()];
          if (!is_kept(edge[0]) || !is_kept(edge[1]))
            continue;
          if (finder == nullptr)
            finder = std::make_unique<mesh::EdgeFinder>(field.edges(), before.size());
          const unsigned int found = finder->find(edge[0], edge[1]);
          if (found != none)
            kept[n] = before.size() + found;
        }
      return kept;
    }

    void
    set(fem::Vector &vector, const unsigned int node, const Tensor<1, 3> &value)
    {
      for (unsigned int c = 0; c < 3; ++c)
        vector.local_element(3 * node + c) = value[c];
    }

    std::shared_ptr<const fem::Pressure>
    interpolate(const mesh::NodalField                   &field,
                const PointLocator                       &locator,
                std::shared_ptr<const fem::PressureSpace> space)
    {
      fem::Vector           values(space->vector_layout());
      std::vector<Point<3>> vertices(space->n_owned_nodes());
      for (unsigned int n = 0; n < vertices.size(); ++n)
        vertices[n]
          = space->displacements().tet_mesh().points[space->nodes()->vertex(space->field_node(n))];
      const std::vector<Location> at = locator.locate(vertices);
      for (unsigned int n = 0; n < vertices.size(); ++n)
        values.local_element(n) = field.pressure->value(at[n].cell, at[n].barycentric);
      return std::make_shared<const fem::Pressure>(std::move(space), std::move(values));
    }
  } // namespace

  std::shared_ptr<const fem::Field>
  interpolate(const mesh::NodalField                   &field,
              const PointLocator                       &locator,
              std::shared_ptr<const fem::Space>         space,
              std::shared_ptr<const fem::PressureSpace> pressures)
  {
    fem::Vector               values(space->vector_layout());
    const auto                kept = kept_nodes(field, *space);
    std::vector<unsigned int> nodes; // that have to be located
    std::vector<Point<3>>     positions;
    for (unsigned int n = 0; n < kept.size(); ++n)
      if (kept[n] != none)
        set(values, n, field.values[kept[n]]);
      else
        {
          nodes.push_back(n);
          positions.push_back(space->node_position(n));
        }
    const std::vector<Location> locations = locator.locate(positions);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      set(values, nodes[i], field.value(locations[i].cell, locations[i].barycentric));
    std::shared_ptr<const fem::Pressure> pressure;
    if (field.pressure && pressures != nullptr)
      pressure = interpolate(field, locator, std::move(pressures));
    return std::make_shared<const fem::Field>(std::move(space),
                                              std::move(values),
                                              std::move(pressure));
  }
} // namespace tetradapt::compare
