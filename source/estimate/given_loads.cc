// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/given_loads.h"

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
      for (unsigned int c = 0; c < 3; ++c)
        if (support.components[c])
          for_patches("Supports/" + support.name, [c](PatchConditions &patch) {
            patch.held |= 1u << c;
            patch.known &= ~(1u << c);
          });
    for (const auto &load : scene.loads)
      if (load.type == scene::LoadType::nodal_force)
        for_patches("Loads/" + load.name, [](PatchConditions &patch) { patch.known = 0; });
  }

  Tensor<1, 3>
  GivenLoads::traction(const unsigned int  face,
                       const Point<3>     &point,
                       const Tensor<1, 3> &normal) const
  {
    Tensor<1, 3> sum;
    for (const unsigned int load : surface_loads.on_face(face))
      sum += surface_loads.traction(load, face, point, normal);
    return sum;
  }

  Tensor<1, 3>
  GivenLoads::surface_traction(const unsigned int face, const mesh::SurfacePoint &at) const
  {
    Tensor<1, 3> sum;
    for (const unsigned int load : surface_loads.on_face(face))
      sum += surface_loads.surface_traction(load, at);
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
