// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_loads.h"

#include "tetradapt/mechanics/surface_loads.h"
#include "tetradapt/mechanics/volume_density.h"
#include "tetradapt/mesh/hexahedral_field.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>

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

    /** Whether each patch of a grid is selected by @p name. */
    std::vector<bool>
    selected_patches(const HexahedralGrid &grid, const std::string &name)
    {
      std::vector<bool> selected;
      for (const auto &patch : grid.patches)
        selected.push_back(std::find(patch.selections.begin(), patch.selections.end(), name)
                           != patch.selections.end());
      return selected;
    }

    /** Forces on the nodes of one cell after another. */
    class CellForces
    {
    public:
      CellForces(const HexahedralSpace &space, Vector &forces)
        : space(space), forces(forces), values(3 * space.nodes_per_cell())
      {
      }
      void
      add(const unsigned int node, const Tensor<1, 3> &force)
      {
        for (unsigned int c = 0; c < 3; ++c)
          values[3 * node + c] += force[c];
      }
      /** Adds what was collected to the forces, as that on own cell @p c. */
      void
      finish(const unsigned int c)
      {
        space.get_dofs(c, dofs);
        space.hanging_nodes().distribute_local_to_global(values, dofs, forces);
        values = 0.;
      }

    private:
      const HexahedralSpace &space;
      Vector                &forces;
      dealii::Vector<double> values;
      HexahedralSpace::Dofs  dofs;
    };

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

    /** Lagrange's functions on a unit square at a point, the first direction fastest. */
    std::vector<double>
    square_functions(const unsigned int degree, const double s, const double t)
    {
      std::array<double, 4> along_s, along_t, unused;
      mesh::lagrange(degree, s, along_s.data(), unused.data());
      mesh::lagrange(degree, t, along_t.data(), unused.data());
      std::vector<double> values;
      for (unsigned int j = 0; j <= degree; ++j)
        for (unsigned int i = 0; i <= degree; ++i)
          values.push_back(along_s[i] * along_t[j]);
      return values;
    }

    /** Adds load @p number of the scene, of which a side is two triangles, each sampled as the
     * faces of tetrahedra are. */
    void
    add_side_load(const scene::LoadParameters   &load,
                  const unsigned int             number,
                  const mechanics::SurfaceLoads &loads,
                  const HexahedralSpace         &space,
                  Vector                        &forces)
    {
      const Line line(space.degree());
      const auto selected = selected_patches(space.forest().grid(), "Loads/" + load.name);
      mechanics::SurfaceLoads::Samples samples;
      CellForces                       cell_forces(space, forces);
      const auto add_side = [&](const HexahedralCell &cell, const unsigned int side) {
        const unsigned int axis = side / 2, first = (axis + 1) % 3, second = (axis + 2) % 3;
        const double       area = cell.size[first] * cell.size[second];
        Tensor<1, 3>       normal;
        normal[axis]        = side % 2 == 1 ? 1. : -1.;
        const auto place_of = [&](double s, double t) {
          Point<3> unit;
          unit[axis]   = side % 2;
          unit[first]  = s;
          unit[second] = t;
          return cell.at(unit);
        };
        const auto add = [&](double s, double t, double weight, const Tensor<1, 3> &value) {
          const auto functions = square_functions(space.degree(), s, t);
          for_side_nodes(line.n, side, [&](unsigned int place, unsigned int i, unsigned int j) {
            cell_forces.add(place, area * weight * functions[j * line.n + i] * value);
          });
        };
        if (loads.is_constant(number))
          {
            const Tensor<1, 3> value = loads.constant_traction(number, normal);
            for (unsigned int s = 0; s < line.gauss.size(); ++s)
              for (unsigned int t = 0; t < line.gauss.size(); ++t)
                add(line.point(s),
                    line.point(t),
                    line.gauss.weight(s) * line.gauss.weight(t),
                    value);
          }
        else
          for (unsigned int half = 0; half < 2; ++half)
            {
              const double h = half;
              loads.sample_triangle(number,
                                    {{place_of(h, h), place_of(1., 0.), place_of(0., 1.)}},
                                    normal,
                                    samples);
              for (const auto &point : samples)
                add(h * point.b[0] + point.b[1],
                    h * point.b[0] + point.b[2],
                    0.5 * point.weight,
                    point.value);
            }
      };
      for (unsigned int c = 0; c < space.forest().cells().size(); ++c)
        {
          const HexahedralCell &cell = space.forest().cells()[c];
          for (unsigned int side = 0; side < 6; ++side)
            if (cell.patches[side] != HexahedralGrid::none && selected[cell.patches[side]])
              {
                add_side(cell, side);
                cell_forces.finish(c);
              }
        }
    }

    /** The six tetrahedra around the diagonal of a unit cube. */
    std::array<std::array<Point<3>, 4>, 6>
    cube_parts()
    {
      std::array<std::array<Point<3>, 4>, 6> parts;
      unsigned int                           order[3] = {0, 1, 2}, n = 0;
      do
        {
          Point<3> corner;
          parts[n][0] = corner;
          for (unsigned int k = 0; k < 3; ++k)
            {
              corner[order[k]] = 1.;
              parts[n][k + 1]  = corner;
            }
          ++n;
      } while (std::next_permutation(order, order + 3));
      return parts;
    }

    /** Calls contribute(cell, place in the unit cube, weight times volume, value) for the points
     * with which a density is integrated over the own cells. */
    template <typename Function>
    void
    sample_cells(const mechanics::VolumeDensity &density,
                 const HexahedralForest         &forest,
                 const Line                     &line,
                 const Function                 &contribute)
    {
      static const auto                 parts = cube_parts();
      mechanics::VolumeDensity::Samples samples;
      const unsigned int                n = line.gauss.size();
      for (unsigned int c = 0; c < forest.cells().size(); ++c)
        {
          const HexahedralCell &cell   = forest.cells()[c];
          const int             region = cell.region;
          if (!density.acts_in(region))
            continue;
          const double volume = cell.size[0] * cell.size[1] * cell.size[2];
          if (density.is_constant(region))
            {
              const Tensor<1, 3> value = density.value(region, Point<3>());
              for (unsigned int q = 0; q < n * n * n; ++q)
                {
                  const unsigned int at[3] = {q % n, q / n % n, q / n / n};
                  Point<3>           unit;
                  double             weight = volume;
                  for (unsigned int d = 0; d < 3; ++d)
                    {
                      unit[d] = line.point(at[d]);
                      weight *= line.gauss.weight(at[d]);
                    }
                  contribute(c, unit, weight, value);
                }
              continue;
            }
          for (const auto &part : parts)
            {
              std::array<Point<3>, 4> corners;
              for (unsigned int i = 0; i < 4; ++i)
                corners[i] = cell.at(part[i]);
              density.sample(region, corners, samples);
              for (const auto &point : samples)
                {
                  Point<3> unit;
                  for (unsigned int i = 0; i < 4; ++i)
                    unit += point.b[i] * Tensor<1, 3>(part[i]);
                  contribute(c, unit, volume / 6. * point.weight, point.value);
                }
            }
        }
    }

    /** Adds int f . v + int S : grad v, for all functions v; act(value, region, f, S) says what a
     * density's value amounts to. */
    template <typename Function>
    void
    add_volume_load(const mechanics::VolumeDensity &density,
                    const HexahedralSpace          &space,
                    const Function                 &act,
                    Vector                         &forces)
    {
      const auto  &cells = space.forest().cells();
      const Line   line(space.degree());
      CellForces   cell_forces(space, forces);
      unsigned int current = 0;
      sample_cells(
        density,
        space.forest(),
        line,
        [&](unsigned int c, const Point<3> &unit, double weight, const Tensor<1, 3> &value) {
          if (c != current)
            cell_forces.finish(current);
          current                               = c;
          const HexahedralCell            &cell = cells[c];
          Tensor<1, 3>                     force;
          mechanics::SymmetricTensor<2, 3> stress;
          act(value, cell.region, force, stress);
          std::array<double, 4> values[3], derivatives[3];
          for (unsigned int d = 0; d < 3; ++d)
            mesh::lagrange(space.degree(), unit[d], values[d].data(), derivatives[d].data());
          for (unsigned int i = 0; i < space.nodes_per_cell(); ++i)
            {
              const unsigned int k[3] = {i % line.n, i / line.n % line.n, i / line.n / line.n};
              double             v[3];
              for (unsigned int d = 0; d < 3; ++d)
                v[d] = values[d][k[d]];
              Tensor<1, 3> gradient;
              for (unsigned int d = 0; d < 3; ++d)
                gradient[d] = derivatives[d][k[d]] / cell.size[d] * v[(d + 1) % 3] * v[(d + 2) % 3];
              cell_forces.add(i, weight * (v[0] * v[1] * v[2] * force + stress * gradient));
            }
        });
      if (!cells.empty())
        cell_forces.finish(current);
    }

    /** Sets an entry of @p held to more than zero for each unknown that @p support holds: those on
     * its sides, and what hanging ones among them depend on, which may lie on no such side.
     * deal.II's interpolate_boundary_values() leaves the latter free. Collective. */
    void
    mark_held(const scene::SupportParameters &support, const HexahedralSpace &space, Vector &held)
    {
      const HexahedralForest &forest = space.forest();
      const auto            selected = selected_patches(forest.grid(), "Supports/" + support.name);
      HexahedralSpace::Dofs dofs;
      held = 0.;
      for (unsigned int c = 0; c < forest.cells().size(); ++c)
        for (unsigned int side = 0; side < 6; ++side)
          {
            const unsigned int patch = forest.cells()[c].patches[side];
            if (patch == HexahedralGrid::none || !selected[patch])
              continue;
            space.get_dofs(c, dofs);
            for_side_nodes(space.degree() + 1, side, [&](unsigned int place, auto, auto) {
              for (unsigned int i = 0; i < 3; ++i)
                if (support.components[i])
                  {
                    const auto  dof     = dofs[3 * place + i];
                    const auto *parents = space.hanging_nodes().get_constraint_entries(dof);
                    if (parents == nullptr)
                      held[dof] = 1.;
                    else
                      for (const auto &[parent, weight] : *parents)
                        if (weight != 0.)
                          held[parent] = 1.;
                  }
            });
          }
      // An unknown may be held here and owned elsewhere.
      held.compress(dealii::VectorOperation::add);
      held.update_ghost_values();
    }

    /** Gives the unknowns that are @p held and not constrained yet their displacement. */
    void
    prescribe(const HexahedralSpace        &space,
              const Vector                 &held,
              const core::VectorExpression &displacement,
              Constraints                  &constraints)
    {
      const auto                                  &element = space.dof_handler().get_fe();
      const auto                                  &points  = element.get_unit_support_points();
      std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
      for (const auto &cell : space.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned() || cell->is_ghost())
          {
            cell->get_dof_indices(dofs);
            const Point<3>     lower = cell->vertex(0);
            const Tensor<1, 3> size  = cell->vertex(7) - lower;
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (held[dofs[i]] != 0. && !constraints.is_constrained(dofs[i]))
                {
                  Point<3> x = lower;
                  for (unsigned int d = 0; d < 3; ++d)
                    x[d] += points[i][d] * size[d];
                  constraints.add_line(dofs[i]);
                  constraints.set_inhomogeneity(
                    dofs[i], displacement(x)[element.system_to_component_index(i).first]);
                }
          }
    }
  } // namespace

  Constraints
  make_constraints(const std::vector<scene::SupportParameters> &supports,
                   const HexahedralSpace                       &space)
  {
    Constraints constraints = space.make_constraints();
    Vector      held(space.dof_handler().locally_owned_dofs(),
                constraints.get_local_lines(),
                space.forest().communicator());
    // What is constrained already stays so: the last of the supports gives the value.
    for (auto support = supports.rbegin(); support != supports.rend(); ++support)
      {
        mark_held(*support, space, held);
        prescribe(space,
                  held,
                  core::VectorExpression(support->displacement,
                                         "Supports/" + support->name + "/Displacement"),
                  constraints);
      }
    constraints.close();
    return constraints;
  }

  void
  nodal_forces(const scene::Scene           &scene,
               const mesh::TetMesh          &mesh,
               const mechanics::MaterialMap &materials,
               const HexahedralSpace        &space,
               Vector                       &forces)
  {
    using mechanics::SymmetricTensor;
    forces = 0.;
    const mechanics::SurfaceLoads surface_loads(scene, mesh);
    for (const auto &force : materials.body_forces())
      force.second->look_at(mesh);
    for (unsigned int number = 0; number < scene.loads.size(); ++number)
      switch (scene.loads[number].type)
        {
        case scene::LoadType::traction:
        case scene::LoadType::pressure:
        case scene::LoadType::total_force:
          add_side_load(scene.loads[number], number, surface_loads, space, forces);
          break;
        case scene::LoadType::body_force:
        case scene::LoadType::gravity:
        case scene::LoadType::rotation:
          add_volume_load(
            *materials.body_forces().at(number),
            space,
            [](const Tensor<1, 3> &value, int, Tensor<1, 3> &force, SymmetricTensor<2, 3> &) {
              force = value;
            },
            forces);
          break;
        case scene::LoadType::nodal_force: // refused with the grid
        case scene::LoadType::point_force: // refused with the scene
        case scene::LoadType::temperature: // all of them together below
          break;
        }
    if (materials.has_thermal_strain())
      materials.thermal_density().look_at(mesh);
    if (materials.has_thermal_strain())
      add_volume_load(
        materials.thermal_density(),
        space,
        [&](const Tensor<1, 3> &value, int region, Tensor<1, 3> &, SymmetricTensor<2, 3> &stress) {
          stress = materials.linear_law(region).stress(
            value[0] * Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()));
        },
        forces);
    forces.compress(dealii::VectorOperation::add);
  }
} // namespace tetradapt::solve
