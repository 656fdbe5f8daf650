// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/given_loads.h"

#include "tetradapt/mechanics/held_directions.h"
#include "tetradapt/mechanics/supports.h"

#include <algorithm>

namespace tetradapt::estimate
{
  GivenLoads::GivenLoads(const scene::Scene           &scene,
                         const mechanics::MaterialMap &materials,
                         const mesh::TetMesh          &mesh)
    : mesh(mesh), materials(materials), surface_loads(scene, mesh), patches(mesh.patches.size())
  {
    const auto for_patches = [&](const std::string &selection, const auto &action) {
      for (unsigned int p = 0; p < patches.size(); ++p)
        {
          const auto &names = mesh.patches[p].selections;
          if (std::find(names.begin(), names.end(), selection) != names.end())
            action(patches[p]);
        }
    };
    for (const auto &support : scene.supports)
      if (support.type == scene::SupportType::sliding)
        for_patches("Supports/" + support.name,
                    [](PatchConditions &patch) { patch.slides = true; });
    for (const auto &support : scene.supports)
      for (unsigned int c = 0; c < 3; ++c)
        if (support.type == scene::SupportType::rigid
            || (support.type == scene::SupportType::fixed && support.components[c]))
          for_patches("Supports/" + support.name, [c](PatchConditions &patch) {
            patch.held |= 1u << c;
            patch.known &= ~(1u << c);
          });
    for (const auto &load : scene.loads)
      if (load.type == scene::LoadType::nodal_force)
        for_patches("Loads/" + load.name, [](PatchConditions &patch) {
          patch.known            = 0;
          patch.has_nodal_forces = true;
        });
    for (PatchConditions &patch : patches)
      if (patch.slides)
        patch.known = 0;
  }

  std::vector<Tensor<1, 3>>
  GivenLoads::known_directions(const unsigned int face, const Tensor<1, 3> &normal) const
  {
    const PatchConditions &patch = patches[mesh.faces[face].patch];
    if (patch.has_nodal_forces)
      return {};
    mechanics::HeldDirections held;
    held.add(normal, 0., 0);
    for (unsigned int c = 0; c < 3; ++c)
      if ((patch.held >> c & 1) != 0)
        {
          Tensor<1, 3> axis;
          axis[c] = 1.;
          held.add(axis, 0., 0);
        }
    return held.others();
  }

  GivenLoads::GivenLoads(const scene::Scene           &scene,
                         const mechanics::MaterialMap &materials,
                         const mesh::NodalField       &displacement)
    : GivenLoads(scene, materials, displacement.mesh())
  {
    springs = std::make_unique<mechanics::Springs>(scene, mesh);
    if (springs->empty())
      {
        springs.reset();
        return;
      }
    this->displacement = &displacement;
    face_nodes         = mechanics::boundary_face_nodes(mesh,
                                                displacement.degree() == 1 ? nullptr
                                                                                   : &displacement.edges());
  }

  Tensor<1, 3>
  GivenLoads::displacement_at(const unsigned int face, const std::array<double, 3> &b) const
  {
    double N[6];
    mechanics::face_shape_values(displacement->degree(), b, N);
    Tensor<1, 3> u;
    for (unsigned int i = 0; i < (displacement->degree() == 1 ? 3 : 6); ++i)
      u += N[i] * displacement->values[face_nodes[face][i]];
    return u;
  }

  Tensor<1, 3>
  GivenLoads::displacement_at(const unsigned int face, const Point<3> &point) const
  {
    // Barycentric coordinates of the foot in the face's plane are ratios of areas.
    const auto                   &v    = mesh.faces[face].vertices;
    const Tensor<1, 3>            area = mesh::face_area_vector(mesh, mesh.faces[face]);
    const std::array<Point<3>, 3> x = {{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]}};
    const double                  square = area.norm_square();
    std::array<double, 3>         b;
    for (unsigned int i = 0; i < 3; ++i)
      b[i] = 0.5 * (dealii::cross_product_3d(x[(i + 1) % 3] - point, x[(i + 2) % 3] - point) * area)
             / square;
    return displacement_at(face, b);
  }

  Tensor<1, 3>
  GivenLoads::traction(const unsigned int  face,
                       const Point<3>     &point,
                       const Tensor<1, 3> &normal) const
  {
    Tensor<1, 3> sum;
    for (const unsigned int load : surface_loads.on_face(face))
      sum += surface_loads.traction(load, face, point, normal);
    if (springs && springs->act_on(face))
      sum += springs->traction(face,
                               point,
                               surface().is_projected(face) ? surface().at(face, point).normal
                                                            : normal,
                               displacement_at(face, point));
    return sum;
  }

  Tensor<1, 3>
  GivenLoads::surface_traction(const unsigned int face, const mesh::SurfacePoint &at) const
  {
    Tensor<1, 3> sum;
    for (const unsigned int load : surface_loads.on_face(face))
      sum += surface_loads.surface_traction(load, at);
    if (springs && springs->act_on(face))
      sum += springs->traction(face, at.point, at.normal, displacement_at(face, at.point));
    return sum;
  }

  Tensor<1, 3>
  GivenLoads::body_force(const unsigned int cell, const Point<3> &point) const
  {
    Tensor<1, 3> sum;
    for (const auto &force : materials.body_forces())
      sum += force.second->value(mesh.regions[cell], point);
    return sum;
  }

  const mechanics::SurfaceLoads::Samples &
  GivenLoads::face_points(const unsigned int face) const
  {
    most_on_face.clear();
    for (const unsigned int load : surface_loads.on_face(face))
      {
        surface_loads.sample(load, face, face_samples);
        if (face_samples.size() > most_on_face.size())
          most_on_face.swap(face_samples);
      }
    if (!springs)
      return most_on_face;
    const double area       = mesh::face_area_vector(mesh, mesh.faces[face]).norm();
    const auto [begin, end] = springs->on_face(face);
    for (auto spring = begin; spring != end; ++spring)
      if (spring->points.size() > most_on_face.size())
        {
          most_on_face.clear();
          for (const auto &point : spring->points)
            most_on_face.push_back(
              {point.b, point.weight / area, point.traction(displacement_at(face, point.b))});
        }
    return most_on_face;
  }

  const mechanics::VolumeDensity::Samples &
  GivenLoads::cell_points(const unsigned int cell) const
  {
    most_in_cell.clear();
    for (const auto &force : materials.body_forces())
      if (force.second->acts_in(mesh.regions[cell]))
        {
          force.second->sample(mesh, cell, cell_samples);
          if (cell_samples.size() > most_in_cell.size())
            most_in_cell.swap(cell_samples);
        }
    return most_in_cell;
  }

  bool
  GivenLoads::is_constant_on(const unsigned int face) const
  {
    if (springs && springs->act_on(face))
      return false;
    const auto &loads = surface_loads.on_face(face);
    return std::all_of(loads.begin(), loads.end(), [&](const unsigned int load) {
      return surface_loads.is_constant(load);
    });
  }

  bool
  GivenLoads::is_constant_in(const unsigned int cell) const
  {
    const auto &forces = materials.body_forces();
    return std::all_of(forces.begin(), forces.end(), [&](const auto &force) {
      return force.second->is_constant(mesh.regions[cell]);
    });
  }
} // namespace tetradapt::estimate
