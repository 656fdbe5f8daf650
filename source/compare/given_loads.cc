// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/given_loads.h"

#include <algorithm>

namespace tetradapt::compare
{
  GivenLoads::Value::Value(const std::array<std::string, 3> &texts, const std::string &what)
    : expression(texts, what), is_constant(expression.is_constant()),
      uses_normal(expression.uses_normal())
  {
    if (is_constant)
      constant = expression(Point<3>(), Tensor<1, 3>());
  }

  GivenLoads::GivenLoads(const scene::Scene           &scene,
                         const mechanics::MaterialMap &materials,
                         const mesh::TetMesh          &mesh)
    : mesh(mesh), mesh_parameters(scene.mesh), patches(mesh.patches.size())
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
      {
        const std::string what  = "Loads/" + load.name;
        const unsigned    value = values.size();
        switch (load.type)
          {
          case scene::LoadType::traction:
          case scene::LoadType::pressure:
            {
              const bool is_pressure = load.type == scene::LoadType::pressure;
              values.emplace_back(is_pressure
                                    ? std::array<std::string, 3>{{load.value[0], "0", "0"}}
                                    : load.value,
                                  what + "/Value");
              for_patches(what, [&](PatchConditions &patch) {
                patch.loads.push_back({value, is_pressure});
              });
              break;
            }
          case scene::LoadType::nodal_force:
            for_patches(what, [](PatchConditions &patch) { patch.known = 0; });
            break;
          case scene::LoadType::body_force:
          case scene::LoadType::gravity:
            values.emplace_back(load.value, what + "/Value");
            body_forces.push_back({value, {}});
            for (const int region :
                 mechanics::resolve_regions(load.selector.ids, load.selector.groups, mesh, what))
              body_forces.back().factors[region]
                = load.type == scene::LoadType::gravity ? materials.parameters(region).density : 1.;
            break;
          case scene::LoadType::temperature:
            break; // not a force: its stress is part of the law's
          case scene::LoadType::point_force:
            break; // no force per area or volume
          }
      }
  }

  Tensor<1, 3>
  GivenLoads::traction(const unsigned int  face,
                       const Point<3>     &point,
                       const Tensor<1, 3> &normal) const
  {
    Tensor<1, 3> sum;
    for (const auto &load : patches[mesh.faces[face].patch].loads)
      {
        const Value       &given = values[load.value];
        const Tensor<1, 3> value
          = given.uses_normal ? given(point, surface().at(face, point).normal) : given(point);
        sum += load.is_pressure ? -value[0] * normal : value;
      }
    return sum;
  }

  Tensor<1, 3>
  GivenLoads::surface_traction(const unsigned int face, const mesh::SurfacePoint &at) const
  {
    Tensor<1, 3> sum;
    for (const auto &load : patches[mesh.faces[face].patch].loads)
      {
        const Tensor<1, 3> value = values[load.value](at.point, at.normal);
        sum += load.is_pressure ? -value[0] * at.normal : value;
      }
    return sum;
  }

  const mesh::TrueSurface &
  GivenLoads::surface() const
  {
    if (true_surface == nullptr)
      true_surface = std::make_unique<mesh::TrueSurface>(mesh_parameters, mesh);
    return *true_surface;
  }

  Tensor<1, 3>
  GivenLoads::body_force(const unsigned int cell, const Point<3> &point) const
  {
    Tensor<1, 3> sum;
    for (const auto &force : body_forces)
      {
        const auto factor = force.factors.find(mesh.regions[cell]);
        if (factor != force.factors.end())
          sum += factor->second * values[force.value](point);
      }
    return sum;
  }
} // namespace tetradapt::compare
