// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_loads.h"

#include "tetradapt/core/surface_expression.h"
#include "tetradapt/mesh/hexahedral_field.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    /** One-dimensional functions at the points of Gauss' rule. */
    struct Line
    {
      explicit Line(const unsigned int degree)
        : gauss(degree + 2), n(degree + 1), values(gauss.size()), derivatives(gauss.size())
      {
        for (unsigned int q = 0; q < gauss.size(); ++q)
          mesh::lagrange(degree, gauss.point(q)[0], values[q].data(), derivatives[q].data());
      }
      double
      point(unsigned int q) const
      {
        return gauss.point(q)[0];
      }

      dealii::QGauss<1>                  gauss;
      unsigned int                       n; ///< nodes
      std::vector<std::array<double, 4>> values, derivatives;
    };

    /** Calls function(cell, side) for the own cells' sides that @p name selects. */
    template <typename Function>
    void
    for_selected_sides(const HexahedralForest &forest,
                       const std::string      &name,
                       const Function         &function)
    {
      const HexahedralGrid &grid = forest.grid();
      std::vector<bool>     selected;
      for (const auto &patch : grid.patches)
        selected.push_back(std::find(patch.selections.begin(), patch.selections.end(), name)
                           != patch.selections.end());
      for (unsigned int c = 0; c < forest.cells().size(); ++c)
        for (unsigned int side = 0; side < 6; ++side)
          if ((forest.cells()[c].outer >> side & 1) != 0
              && selected[grid.sides[forest.cells()[c].brick][side]])
            function(c, side);
    }

    /** Calls function(place of the node in the cell, first and second position) for the
     * nodes on a side. */
    template <typename Function>
    void
    for_side_nodes(const unsigned int n, const unsigned int side, const Function &function)
    {
      const unsigned int stride[3] = {1, n, n * n};
      const unsigned int axis = side / 2, first = (axis + 1) % 3, second = (axis + 2) % 3;
      const unsigned int start = side % 2 == 1 ? (n - 1) * stride[axis] : 0;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          function(start + i * stride[first] + j * stride[second], i, j);
    }

    void
    add_side_load(const scene::LoadParameters &load,
                  const HexahedralForest      &forest,
                  const HexahedralSpace       &space,
                  Vector                      &forces)
    {
      const bool pressure = load.type == scene::LoadType::pressure;
      const auto texts
        = pressure ? std::array<std::string, 3>{{load.value[0], "0", "0"}} : load.value;
      const core::SurfaceExpression value(texts, "Loads/" + load.name + "/Value");
      const Line                    line(space.degree);
      for_selected_sides(forest, "Loads/" + load.name, [&](unsigned int c, unsigned int side) {
        const HexahedralCell     &cell = forest.cells()[c];
        const unsigned int        axis = side / 2, first = (axis + 1) % 3, second = (axis + 2) % 3;
        const double              area = cell.size[first] * cell.size[second];
        std::vector<Tensor<1, 3>> at_nodes(space.nodes_per_cell);
        for (unsigned int s = 0; s < line.gauss.size(); ++s)
          for (unsigned int t = 0; t < line.gauss.size(); ++t)
            {
              Point<3> unit;
              unit[axis]   = side % 2;
              unit[first]  = line.point(s);
              unit[second] = line.point(t);
              Tensor<1, 3> normal;
              normal[axis]       = side % 2 == 1 ? 1. : -1.;
              Tensor<1, 3> force = value(cell.at(unit), normal);
              if (pressure)
                {
                  force = -force[0] * normal;
                }
              force *= area * line.gauss.weight(s) * line.gauss.weight(t);
              for_side_nodes(line.n, side, [&](unsigned int place, unsigned int i, unsigned int j) {
                at_nodes[place] += line.values[s][i] * line.values[t][j] * force;
              });
            }
        for_side_nodes(line.n, side, [&](unsigned int place, unsigned int, unsigned int) {
          space.add(forces, space.nodes(c)[place], at_nodes[place]);
        });
      });
    }

    /** Adds int density . v + int stress : grad v; contribute(region, x, density, stress)
     * adds to what acts at x. */
    template <typename Function>
    void
    add_volume_load(const std::set<int>    &regions,
                    const HexahedralForest &forest,
                    const HexahedralSpace  &space,
                    const Function         &contribute,
                    Vector                 &forces)
    {
      const Line                line(space.degree);
      const unsigned int        n_points = line.gauss.size();
      std::vector<Tensor<1, 3>> at_nodes(space.nodes_per_cell);
      for (unsigned int c = 0; c < forest.cells().size(); ++c)
        {
          const HexahedralCell &cell   = forest.cells()[c];
          const int             region = forest.grid().regions[cell.brick];
          if (regions.count(region) == 0)
            continue;
          const double volume = cell.size[0] * cell.size[1] * cell.size[2];
          std::fill(at_nodes.begin(), at_nodes.end(), Tensor<1, 3>());
          for (unsigned int q = 0; q < n_points * n_points * n_points; ++q)
            {
              const unsigned int at[3]
                = {q % n_points, q / n_points % n_points, q / n_points / n_points};
              Point<3> unit;
              double   weight = volume;
              for (unsigned int d = 0; d < 3; ++d)
                {
                  unit[d] = line.point(at[d]);
                  weight *= line.gauss.weight(at[d]);
                }
              Tensor<1, 3>                     density;
              mechanics::SymmetricTensor<2, 3> stress;
              contribute(region, cell.at(unit), density, stress);
              for (unsigned int i = 0; i < space.nodes_per_cell; ++i)
                {
                  const unsigned int k[3] = {i % line.n, i / line.n % line.n, i / line.n / line.n};
                  double             v[3];
                  for (unsigned int d = 0; d < 3; ++d)
                    v[d] = line.values[at[d]][k[d]];
                  Tensor<1, 3> gradient;
                  for (unsigned int d = 0; d < 3; ++d)
                    gradient[d] = line.derivatives[at[d]][k[d]] / cell.size[d] * v[(d + 1) % 3]
                                  * v[(d + 2) % 3];
                  at_nodes[i] += weight * (v[0] * v[1] * v[2] * density + stress * gradient);
                }
            }
          for (unsigned int i = 0; i < space.nodes_per_cell; ++i)
            space.add(forces, space.nodes(c)[i], at_nodes[i]);
        }
    }
  } // namespace

  Vector
  node_positions(const HexahedralForest &forest, const HexahedralSpace &space)
  {
    Vector             positions(space.layout);
    const auto         along = mesh::hexahedral_nodes(space.degree);
    const unsigned int n     = along.size();
    for (unsigned int c = 0; c < forest.cells().size(); ++c)
      for (unsigned int i = 0; i < space.nodes_per_cell; ++i)
        {
          const unsigned int node = space.nodes(c)[i];
          if (node >= space.n_owned)
            continue;
          const Point<3> x
            = forest.cells()[c].at({along[i % n], along[i / n % n], along[i / n / n]});
          for (unsigned int d = 0; d < 3; ++d)
            positions.local_element(3 * node + d) = x[d];
        }
    positions.update_ghost_values();
    return positions;
  }

  void
  HexahedralSupports::set_zero(Vector &vector) const
  {
    const unsigned int n_owned = vector.locally_owned_size() / 3;
    for (unsigned int node = 0; node < n_owned; ++node)
      for (unsigned int c = 0; fixed[node] != 0 && c < 3; ++c)
        if ((fixed[node] >> c & 1) != 0)
          vector.local_element(3 * node + c) = 0.;
  }

  HexahedralSupports
  prescribe(const std::vector<scene::SupportParameters> &supports,
            const HexahedralForest                      &forest,
            const HexahedralSpace                       &space,
            const Vector                                &positions)
  {
    HexahedralSupports result;
    result.fixed.assign(space.n_local, 0);
    result.values.reinit(space.layout);
    for (const auto &support : supports)
      {
        const core::VectorExpression displacement(support.displacement,
                                                  "Supports/" + support.name + "/Displacement");
        // A node may be known here and owned elsewhere: its owner is told by a sum.
        Vector touched(space.layout);
        for_selected_sides(forest,
                           "Supports/" + support.name,
                           [&](unsigned int c, unsigned int side) {
                             for_side_nodes(space.degree + 1,
                                            side,
                                            [&](unsigned int place, unsigned int, unsigned int) {
                                              space.expand(space.nodes(c)[place],
                                                           [&](unsigned int node, double weight) {
                                                             if (weight != 0.)
                                                               touched.local_element(3 * node) = 1.;
                                                           });
                                            });
                           });
        touched.compress(dealii::VectorOperation::add);
        touched.update_ghost_values();
        for (unsigned int node = 0; node < space.n_local; ++node)
          if (touched.local_element(3 * node) != 0.)
            {
              Point<3> x;
              for (unsigned int d = 0; d < 3; ++d)
                x[d] = positions.local_element(3 * node + d);
              const Tensor<1, 3> value = displacement(x);
              for (unsigned int c = 0; c < 3; ++c)
                if (support.components[c])
                  {
                    result.fixed[node] |= 1u << c;
                    result.values.local_element(3 * node + c) = value[c];
                  }
            }
      }
    result.values.zero_out_ghost_values();
    return result;
  }

  Vector
  nodal_forces(const scene::Scene           &scene,
               const mesh::TetMesh          &mesh,
               const mechanics::MaterialMap &materials,
               const HexahedralForest       &forest,
               const HexahedralSpace        &space)
  {
    using mechanics::SymmetricTensor;
    Vector forces(space.layout);
    for (const auto &load : scene.loads)
      {
        const std::string what = "Loads/" + load.name;
        switch (load.type)
          {
          case scene::LoadType::traction:
          case scene::LoadType::pressure:
            add_side_load(load, forest, space, forces);
            break;
          case scene::LoadType::body_force:
          case scene::LoadType::gravity:
            {
              const core::VectorExpression value(load.value, what + "/Value");
              add_volume_load(
                mechanics::resolve_regions(load.selector.ids, load.selector.groups, mesh, what),
                forest,
                space,
                [&](int region, const Point<3> &x, Tensor<1, 3> &density, SymmetricTensor<2, 3> &) {
                  density = value(x);
                  if (load.type == scene::LoadType::gravity)
                    density *= materials.parameters(region).density;
                },
                forces);
              break;
            }
          case scene::LoadType::nodal_force: // refused with the grid
          case scene::LoadType::point_force: // refused with the scene
          case scene::LoadType::temperature: // all of them together below
            break;
          }
      }
    if (materials.has_thermal_strain())
      add_volume_load(
        std::set<int>(mesh.regions.begin(), mesh.regions.end()),
        forest,
        space,
        [&](int region, const Point<3> &x, Tensor<1, 3> &, SymmetricTensor<2, 3> &stress) {
          stress = materials.law(region).stress(Tensor<2, 3>(materials.thermal_strain(region, x)));
        },
        forces);
    forces.compress(dealii::VectorOperation::add);
    return forces;
  }
} // namespace tetradapt::solve
