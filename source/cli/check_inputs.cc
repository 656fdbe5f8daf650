// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/check_inputs.h"

#include "tetradapt/geometry/surface_checks.h"
#include "tetradapt/geometry/surface_io.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/mesh_factory.h"
#include "tetradapt/mesh/volume_reader.h"

#include <algorithm>

namespace tetradapt::cli
{
  void
  check_inputs(const scene::Scene &scene)
  {
    const scene::MeshParameters &mesh    = scene.mesh;
    const bool                   refined = !mesh.size.empty()
                         || std::any_of(mesh.volume_bounds.begin(),
                                        mesh.volume_bounds.end(),
                                        [](double bound) { return bound > 0.; });
    const bool given = mesh.source == scene::MeshSource::bricks
                       || (mesh.source == scene::MeshSource::file && !refined);
    for (unsigned int number = 0; given && number < mesh.n_meshes(); ++number)
      const mechanics::MaterialMap materials(scene, mesh::make_mesh(scene, number, core::Log()));
    if (!given)
      for (const std::string &file : mesh.files)
        {
          if (mesh.source == scene::MeshSource::surface)
            geometry::check_surface(geometry::read_surface(file), file);
          else if (mesh.source == scene::MeshSource::file)
            mesh::read_volume_mesh(file);
        }
    using Reference = scene::ReferenceParameters;
    if (scene.reference.type == Reference::Type::run
        || (scene.reference.type == Reference::Type::fine_mesh
            && scene.reference.route == Reference::MeshRoute::file))
      mesh::read_volume_mesh(scene.reference.file);
  }
} // namespace tetradapt::cli
