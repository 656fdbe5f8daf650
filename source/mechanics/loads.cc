// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/loads.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/surface_expression.h"
#include "tetradapt/mechanics/point_conditions.h"
#include "tetradapt/mesh/true_surface.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace tetradapt::mechanics
{
  namespace
  {
    using dealii::Point;
    using Forces = std::vector<Tensor<1, 3>>;

    /** Shape functions of a triangle at the points of a quadrature rule. */
    struct FaceShapes
    {
      explicit FaceShapes(unsigned int degree) : quadrature(3), n_nodes(degree == 1 ? 3 : 6)
      {
        for (const auto &q : quadrature.get_points())
          {
            const std::array<double, 3> b{{1. - q[0] - q[1], q[0], q[1]}};
            std::array<double, 6>       N{};
            for (unsigned int i = 0; i < 3; ++i)
              {
                N[i]     = degree == 1 ? b[i] : b[i] * (2. * b[i] - 1.);
                N[3 + i] = 4. * b[i] * b[(i + 1) % 3];
              }
            barycentric.push_back(b);
            values.push_back(N);
          }
      }

      dealii::QGaussSimplex<2>           quadrature;
      unsigned int                       n_nodes;
      std::vector<std::array<double, 3>> barycentric;
      std::vector<std::array<double, 6>> values;
    };

    bool
    carries(const mesh::TetMesh         &mesh,
            const mesh::BoundaryFace    &face,
            const scene::LoadParameters &load)
    {
      const auto &selections = mesh.patches[face.patch].selections;
      return std::find(selections.begin(), selections.end(), "Loads/" + load.name)
             != selections.end();
    }

    void
    add_face_load(const scene::LoadParameters                    &load,
                  const scene::MeshParameters                    &mesh_parameters,
                  const mesh::TetMesh                            &mesh,
                  const FaceShapes                               &shapes,
                  const std::vector<std::array<unsigned int, 6>> &face_nodes,
                  Forces                                         &forces)
    {
      const std::string what     = "Loads/" + load.name + "/Value";
      const bool        pressure = load.type == scene::LoadType::pressure;
      const auto        texts
        = pressure ? std::array<std::string, 3>{{load.value[0], "0", "0"}} : load.value;
      const core::SurfaceExpression value(texts, what);
      const bool                    uses_normal = value.uses_normal();
      const mesh::TrueSurface       surface(uses_normal ? mesh_parameters : scene::MeshParameters(),
                                      mesh);
      for (unsigned int f = 0; f < mesh.faces.size(); ++f)
        {
          if (!carries(mesh, mesh.faces[f], load))
            continue;
          const auto        &v    = mesh.faces[f].vertices;
          const Tensor<1, 3> area = mesh::face_area_vector(mesh, mesh.faces[f]); // outward
          for (unsigned int q = 0; q < shapes.values.size(); ++q)
            {
              Point<3> x;
              for (unsigned int i = 0; i < 3; ++i)
                x += shapes.barycentric[q][i] * Tensor<1, 3>(mesh.points[v[i]]);
              // The rule's weights sum to 1/2, the area of the unit triangle.
              const double       weight = 2. * shapes.quadrature.weight(q);
              const Tensor<1, 3> given
                = value(x, uses_normal ? surface.at(f, x).normal : Tensor<1, 3>());
              const Tensor<1, 3> force
                = weight * (pressure ? -given[0] * area : area.norm() * given);
              for (unsigned int i = 0; i < shapes.n_nodes; ++i)
                forces[face_nodes[f][i]] += shapes.values[q][i] * force;
            }
        }
    }

    /** The force at every point of the mesh that a selected face has, once each
     * however many of its faces are selected. Middles of edges are no points of the
     * mesh, so that both degrees get the same load. */
    void
    add_node_load(const scene::LoadParameters &load, const mesh::TetMesh &mesh, Forces &forces)
    {
      const core::VectorExpression value(load.value, "Loads/" + load.name + "/Value");
      std::vector<bool>            loaded(mesh.n_points(), false);
      for (const auto &face : mesh.faces)
        if (carries(mesh, face, load))
          for (const unsigned int point : face.vertices)
            loaded[point] = true;
      for (unsigned int point = 0; point < mesh.n_points(); ++point)
        if (loaded[point])
          forces[point] += value(mesh.points[point]);
    }

    /** Quadrature points of a cell: positions, weights times volume. */
    class CellLoop
    {
    public:
      explicit CellLoop(const DisplacementSpace &space) : space(space), quadrature(3)
      {
        for (const auto &q : quadrature.get_points())
          {
            const mesh::Barycentric b{{1. - q[0] - q[1] - q[2], q[0], q[1], q[2]}};
            std::array<double, 10>  N{};
            mesh::shape_values(space.degree(), b, N.data());
            barycentric.push_back(b);
            values.push_back(N);
          }
      }

      /** Calls @p contribute(cell, quadrature point number, position, weight). */
      template <typename Function>
      void
      run(const std::set<int> &regions, const Function &contribute) const
      {
        const mesh::TetMesh &mesh = space.tet_mesh();
        for (const unsigned int cell : space.touching_cells())
          if (regions.count(mesh.regions[cell]) != 0)
            {
              const double volume = mesh::cell_volume(mesh, cell);
              for (unsigned int q = 0; q < values.size(); ++q)
                {
                  Point<3> x;
                  for (unsigned int i = 0; i < 4; ++i)
                    x += barycentric[q][i] * Tensor<1, 3>(mesh.points[mesh.cells[cell][i]]);
                  contribute(cell, q, x, 6. * volume * quadrature.weight(q));
                }
            }
      }

      const DisplacementSpace            &space;
      dealii::QGaussSimplex<3>            quadrature;
      std::vector<mesh::Barycentric>      barycentric;
      std::vector<std::array<double, 10>> values;
    };

    void
    add_volume_load(const scene::LoadParameters &load,
                    const MaterialMap           &materials,
                    const CellLoop              &loop,
                    Forces                      &forces)
    {
      const std::string            what = "Loads/" + load.name;
      const core::VectorExpression value(load.value, what + "/Value");
      const bool                   constant = value.is_constant();
      const Tensor<1, 3>           fixed    = constant ? value(Point<3>()) : Tensor<1, 3>();
      const DisplacementSpace     &space    = loop.space;
      const mesh::TetMesh         &mesh     = space.tet_mesh();
      loop.run(resolve_regions(load.selector.ids, load.selector.groups, mesh, what),
               [&](unsigned int cell, unsigned int q, const Point<3> &x, double weight) {
                 const double       density = load.type == scene::LoadType::gravity
                                                ? materials.parameters(mesh.regions[cell]).density
                                                : 1.;
                 const Tensor<1, 3> force   = weight * density * (constant ? fixed : value(x));
                 for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
                   forces[space.cell_node(cell, i)] += loop.values[q][i] * force;
               });
    }

    void
    add_thermal_load(const MaterialMap &materials, const CellLoop &loop, Forces &forces)
    {
      const DisplacementSpace     &space = loop.space;
      const mesh::TetMesh         &mesh  = space.tet_mesh();
      const std::set<int>          all(mesh.regions.begin(), mesh.regions.end());
      std::array<Tensor<1, 3>, 10> gradients;
      loop.run(all, [&](unsigned int cell, unsigned int q, const Point<3> &x, double weight) {
        const int region = mesh.regions[cell];
        // Force of the stress that would hold the thermal strain back.
        const Tensor<2, 3>          strain(materials.thermal_strain(region, x));
        const SymmetricTensor<2, 3> stress = materials.law(region).stress(strain);
        mesh::shape_gradients(space.degree(),
                              loop.barycentric[q],
                              mesh::barycentric_gradients(mesh, cell),
                              gradients.data());
        for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
          forces[space.cell_node(cell, i)] += weight * (stress * gradients[i]);
      });
    }
  } // namespace

  Forces
  nodal_forces(const scene::Scene      &scene,
               const MaterialMap       &materials,
               const DisplacementSpace &space)
  {
    Forces           forces(space.n_field_nodes());
    const auto      &mesh = space.tet_mesh();
    const FaceShapes face_shapes(space.degree());
    const CellLoop   cell_loop(space);

    std::vector<std::array<unsigned int, 6>> face_nodes;
    for (const auto &load : scene.loads)
      switch (load.type)
        {
        case scene::LoadType::traction:
        case scene::LoadType::pressure:
          if (face_nodes.empty())
            face_nodes = boundary_face_nodes(mesh, space.edge_table());
          add_face_load(load, scene.mesh, mesh, face_shapes, face_nodes, forces);
          break;
        case scene::LoadType::nodal_force:
          add_node_load(load, mesh, forces);
          break;
        case scene::LoadType::point_force:
          add_point_force(load, mesh, forces);
          break;
        case scene::LoadType::body_force:
        case scene::LoadType::gravity:
          add_volume_load(load, materials, cell_loop, forces);
          break;
        case scene::LoadType::temperature:
          break; // all of them together below
        }
    if (materials.has_thermal_strain())
      add_thermal_load(materials, cell_loop, forces);
    return forces;
  }
} // namespace tetradapt::mechanics
