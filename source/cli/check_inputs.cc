// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/check_inputs.h"

#include "tetradapt/adapt/saved_sizes.h"
#include "tetradapt/geometry/surface_checks.h"
#include "tetradapt/geometry/surface_io.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/boundary_projection.h"
#include "tetradapt/mesh/mesh_factory.h"
#include "tetradapt/mesh/selection.h"
#include "tetradapt/mesh/volume_reader.h"
#include "tetradapt/mesh/vtu_reader.h"

#include <algorithm>

namespace tetradapt::cli
{
  namespace
  {
    void
    check_mesh(const scene::Scene &scene)
    {
      const scene::MeshParameters &mesh    = scene.mesh;
      const bool                   refined = !mesh.size.empty()
                           || std::any_of(mesh.volume_bounds.begin(),
                                          mesh.volume_bounds.end(),
                                          [](double bound) { return bound > 0.; });
      if (mesh.source == scene::MeshSource::bricks
          || (mesh.source == scene::MeshSource::file && !refined))
        {
          for (unsigned int number = 0; number < mesh.n_meshes(); ++number)
            const mechanics::MaterialMap materials(scene,
                                                   mesh::make_mesh(scene, number, core::Log()));
          return;
        }
      const auto projection = mesh::make_projection(scene);
      for (const std::string &file : mesh.files)
        if (mesh.source == scene::MeshSource::surface)
          geometry::check_surface(geometry::read_surface(file), file);
        else if (mesh.source == scene::MeshSource::file)
          {
            mesh::TetMesh                read = mesh::read_volume_mesh(file);
            const mechanics::MaterialMap materials(scene, read);
            if (projection != nullptr)
              projection->assign(read);
          }
    }

    void
    check_reference(const scene::Scene &scene)
    {
      using Reference        = scene::ReferenceParameters;
      const auto &parameters = scene.reference;
      if (parameters.type == Reference::Type::run)
        mesh::read_displacement_vtu(parameters.file);
      else if (parameters.type == Reference::Type::fine_mesh
               && parameters.route == Reference::MeshRoute::file)
        {
          mesh::TetMesh mesh = mesh::read_volume_mesh(parameters.file);
          mesh::select_faces(mesh, mesh::face_selectors(scene));
        }
    }
  } // namespace

  void
  check_inputs(const scene::Scene &scene)
  {
    check_mesh(scene);
    if (!scene.mesh.size_field.empty())
      const adapt::SavedSizes sizes(scene.mesh.size_field);
    check_reference(scene);
  }
} // namespace tetradapt::cli
