// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/loads.h"

#include "tetradapt/mechanics/point_conditions.h"
#include "tetradapt/mechanics/supports.h"
#include "tetradapt/mechanics/surface_loads.h"
#include "tetradapt/mechanics/volume_density.h"

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace tetradapt::mechanics
{
  namespace
  {
    /** One a local node; only those of owned nodes are complete. */
    using Forces = std::vector<Tensor<1, 3>>;

    /** Shape functions of a triangle of degree 1 or 2 at barycentric coordinates; with one
     * point in all, their means, with which a constant is integrated. */
    std::array<double, 6>
    face_shapes(const unsigned int           degree,
                const std::array<double, 3> &b,
                const std::size_t            n_points)
    {
      if (n_points == 1)
        return degree == 1 ? std::array<double, 6>{{1. / 3., 1. / 3., 1. / 3., 0., 0., 0.}}
                           : std::array<double, 6>{{0., 0., 0., 1. / 3., 1. / 3., 1. / 3.}};
      std::array<double, 6> N{};
      for (unsigned int i = 0; i < 3; ++i)
        {
          N[i]     = degree == 1 ? b[i] : b[i] * (2. * b[i] - 1.);
          N[3 + i] = 4. * b[i] * b[(i + 1) % 3];
        }
      return N;
    }

    /** Puts loads one after the other on the nodes of a mesh. */
    class Assembly
    {
    public:
      Assembly(const scene::Scene &scene, const MaterialMap &materials, const fem::Space &space)
        : scene(scene), materials(materials), space(space), mesh(space.tet_mesh()),
          surface_loads(scene, mesh)
      {
      }

      NodalLoads
      all(const fem::Field *deformation)
      {
        NodalLoads result;
        Forces     sum_of_all(space.n_local_nodes());
        for (unsigned int number = 0; number < scene.loads.size(); ++number)
          {
            LoadTotal total;
            if (scene.loads[number].type != scene::LoadType::temperature)
              {
                forces.assign(space.n_local_nodes(), Tensor<1, 3>());
                add(number, total);
                for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
                  {
                    sum_of_all[node] += forces[node];
                    Point<3> x = space.node_position(node);
                    if (deformation != nullptr)
                      x += deformation->value(node);
                    total.resultant.add(x, forces[node]);
                  }
                total.resultant = sum(total.resultant, space.communicator());
              }
            result.totals.push_back(total);
          }
        // All temperatures together: their stress has no resultant.
        if (materials.has_thermal_strain())
          {
            LoadTotal thermal;
            add_thermal_load(sum_of_all, thermal);
            for (unsigned int number = 0; number < scene.loads.size(); ++number)
              if (scene.loads[number].type == scene::LoadType::temperature)
                {
                  result.totals[number].magnitude = thermal.magnitude;
                  result.totals[number].remainder = thermal.remainder;
                  result.totals[number].remark    = thermal.remark;
                }
          }
        result.forces.reinit(space.vector_layout());
        for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
          for (unsigned int c = 0; c < 3; ++c)
            result.forces.local_element(3 * node + c) = sum_of_all[node][c];
        return result;
      }

    private:
      void
      add(const unsigned int number, LoadTotal &total)
      {
        switch (scene.loads[number].type)
          {
          case scene::LoadType::traction:
          case scene::LoadType::pressure:
          case scene::LoadType::total_force:
            add_face_load(number, total);
            break;
          case scene::LoadType::nodal_force:
            add_node_load(scene.loads[number]);
            break;
          case scene::LoadType::point_force:
            add_point_load(scene.loads[number]);
            break;
          case scene::LoadType::body_force:
          case scene::LoadType::gravity:
          case scene::LoadType::rotation:
            add_volume_load(*materials.body_forces().at(number), total);
            break;
          case scene::LoadType::temperature:
            break;
          }
      }

      /** Where this rank has the node. */
      void
      add_at(const unsigned int field_node, const Tensor<1, 3> &force)
      {
        const unsigned int node = space.local_node(field_node);
        if (node != dealii::numbers::invalid_unsigned_int)
          forces[node] += force;
      }

      /** Every rank looks at all faces, so that each knows the load's total and what is to be
       * remarked of it. */
      void
      add_face_load(const unsigned int number, LoadTotal &total)
      {
        if (face_nodes.empty())
          face_nodes = boundary_face_nodes(mesh, space.edge_table());
        const unsigned int    n_nodes = space.degree() == 1 ? 3 : 6;
        SurfaceLoads::Samples samples;
        for (unsigned int f = 0; f < mesh.faces.size(); ++f)
          {
            const auto &on_face = surface_loads.on_face(f);
            if (std::find(on_face.begin(), on_face.end(), number) == on_face.end())
              continue;
            const double area  = mesh::face_area_vector(mesh, mesh.faces[f]).norm();
            const double error = surface_loads.sample_compactly(number, f, samples);
            total.remainder += area * error;
            for (const auto &point : samples)
              {
                const Tensor<1, 3> force = area * point.weight * point.value;
                total.magnitude += force.norm();
                const auto N = face_shapes(space.degree(), point.b, samples.size());
                for (unsigned int i = 0; i < n_nodes; ++i)
                  add_at(face_nodes[f][i], N[i] * force);
              }
          }
        total.remark = surface_loads.remark(number);
        total.note   = surface_loads.note(number);
      }

      /** The force at every point of the mesh that a selected face has, once each
       * however many of its faces are selected. Middles of edges are no points of the
       * mesh, so that both degrees get the same load. */
      void
      add_node_load(const scene::LoadParameters &load)
      {
        const core::VectorExpression value(load.value, "Loads/" + load.name + "/Value");
        const std::string            selection = "Loads/" + load.name;
        std::vector<bool>            loaded(mesh.n_points(), false);
        for (const auto &face : mesh.faces)
          {
            const auto &names = mesh.patches[face.patch].selections;
            if (std::find(names.begin(), names.end(), selection) != names.end())
              for (const unsigned int point : face.vertices)
                loaded[point] = true;
          }
        for (unsigned int point = 0; point < mesh.n_points(); ++point)
          if (loaded[point])
            add_at(point, value(mesh.points[point]));
      }

      void
      add_point_load(const scene::LoadParameters &load)
      {
        const auto [vertex, force] = point_force(load, mesh);
        add_at(vertex, force);
      }

      void
      add_up(LoadTotal &total) const
      {
        for (double LoadTotal::*part : {&LoadTotal::magnitude, &LoadTotal::remainder})
          total.*part = dealii::Utilities::MPI::sum(total.*part, space.communicator());
      }

      void
      add_volume_load(const VolumeDensity &density, LoadTotal &total)
      {
        density.look_at(mesh); // on every rank, for the remark
        VolumeDensity::Samples samples;
        std::array<double, 10> N{};
        for (unsigned int k = 0; k < space.touching_cells().size(); ++k)
          {
            const unsigned int cell = space.touching_cells()[k];
            if (!density.acts_in(mesh.regions[cell]))
              continue;
            const double volume = mesh::cell_volume(mesh, cell);
            const double error  = density.sample_compactly(mesh, cell, samples);
            const bool   mine   = space.is_own_cell(k);
            total.remainder += mine ? volume * error : 0.;
            for (const auto &point : samples)
              {
                const Tensor<1, 3> force = volume * point.weight * point.value;
                total.magnitude += mine ? force.norm() : 0.;
                if (samples.size() == 1)
                  constant_shapes(N);
                else
                  mesh::shape_values(space.degree(), point.b, N.data());
                for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
                  forces[space.local_nodes_of(k)[i]] += N[i] * force;
              }
          }
        add_up(total);
        total.remark = density.remark();
      }

      /** Mean values of the shape functions: what a constant is integrated with. */
      void
      constant_shapes(std::array<double, 10> &N) const
      {
        const bool linear = space.degree() == 1;
        for (unsigned int i = 0; i < 10; ++i)
          N[i] = linear ? (i < 4 ? 0.25 : 0.) : (i < 4 ? -0.05 : 0.2);
      }

      void
      add_thermal_load(Forces &all, LoadTotal &total) const
      {
        const VolumeDensity &density = materials.thermal_density();
        density.look_at(mesh);
        VolumeDensity::Samples       samples;
        std::array<Tensor<1, 3>, 10> gradients;
        for (unsigned int k = 0; k < space.touching_cells().size(); ++k)
          {
            const unsigned int cell   = space.touching_cells()[k];
            const int          region = mesh.regions[cell];
            if (!density.acts_in(region))
              continue;
            const double volume     = mesh::cell_volume(mesh, cell);
            const auto   directions = mesh::barycentric_gradients(mesh, cell);
            const double error      = density.sample_compactly(mesh, cell, samples);
            const bool   mine       = space.is_own_cell(k);
            total.remainder += mine ? volume * error : 0.;
            for (const auto &point : samples)
              {
                total.magnitude += mine ? volume * point.weight * std::abs(point.value[0]) : 0.;
                // Force of the stress that would hold the thermal strain back.
                const Tensor<2, 3> strain(point.value[0] * dealii::unit_symmetric_tensor<3>());
                const SymmetricTensor<2, 3> stress = materials.linear_law(region).stress(strain);
                // Gradients are linear: their means are the values at the centroid.
                mesh::shape_gradients(space.degree(), point.b, directions, gradients.data());
                for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
                  all[space.local_nodes_of(k)[i]]
                    += volume * point.weight * (stress * gradients[i]);
              }
          }
        add_up(total);
        total.remark = density.remark();
      }

      const scene::Scene  &scene;
      const MaterialMap   &materials;
      const fem::Space    &space;
      const mesh::TetMesh &mesh;
      SurfaceLoads         surface_loads;
      Forces               forces; ///< of one load

      std::vector<std::array<unsigned int, 6>> face_nodes;
    };
  } // namespace

  NodalLoads
  assemble_loads(const scene::Scene &scene,
                 const MaterialMap  &materials,
                 const fem::Space   &space,
                 const fem::Field   *deformation)
  {
    return Assembly(scene, materials, space).all(deformation);
  }
} // namespace tetradapt::mechanics
