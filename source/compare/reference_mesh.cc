// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/reference_mesh.h"

#include "tetradapt/io/volume_reader.h"
#include "tetradapt/mesh/boundary_projection.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/face_selectors.h"
#include "tetradapt/mesh/kept_places.h"
#include "tetradapt/mesh/selection.h"
#include "tetradapt/mesh/size_function.h"

#include <cmath>
#include <sstream>

namespace tetradapt::compare
{
  namespace
  {
    mesh::TetMesh
    refined_mesh(const scene::Scene &scene, const mesh::TetMesh &initial_mesh, const core::Log &log)
    {
      const auto             &parameters = scene.reference;
      scene::TetgenParameters quality    = scene.tetgen;
      quality.radius_edge_ratio          = parameters.radius_edge_ratio;
      quality.dihedral_angle             = parameters.dihedral_angle;
      // A reference of the same body must have the same boundary.
      const auto         projection = mesh::make_projection(scene);
      const mesh::Tetgen tetgen(mesh::quality_for_projection(quality, projection != nullptr));
      log.progress("reference: TetGen refines the initial mesh");
      mesh::TetMesh mesh        = initial_mesh;
      bool          cap_reached = false;
      if (parameters.volume_bound > 0.)
        {
          mesh::Sizing       sizing;
          mesh::TetgenReport report;
          sizing.max_volume = parameters.volume_bound;
          mesh              = tetgen.refine(mesh, sizing, &report);
          if (projection != nullptr)
            projection->project(mesh);
          cap_reached = report.cap_reached;
        }
      if (!parameters.size.empty())
        {
          mesh::SizeReport report;
          mesh        = mesh::mesh_with_size(tetgen,
                                      mesh,
                                      core::Expression(parameters.size, "Reference/Size"),
                                      &report,
                                      mesh::project_on(projection.get()));
          cap_reached = cap_reached || report.cap_reached;
        }
      if (cap_reached)
        log.warning("TetGen/Steiner points stopped the refinement of the reference's mesh: it is "
                    "coarser than asked for. Raise the limit.");
      return mesh;
    }

    /** Warns where the two meshes are not held or loaded on the same area. */
    void
    compare_selections(const mesh::TetMesh &initial_mesh,
                       const mesh::TetMesh &reference,
                       const core::Log     &log)
    {
      constexpr double same_area = 1e-3;
      auto             areas     = mesh::selected_areas(reference);
      for (const auto &[name, area] : mesh::selected_areas(initial_mesh))
        {
          const auto found = areas.find(name);
          if (found == areas.end() || std::abs(found->second - area) <= same_area * area)
            continue;
          std::ostringstream text;
          text << name << " selects an area of " << found->second
               << " on the reference's mesh, but of " << area
               << " on the scene's first mesh. The error measured includes the difference ("
               << 100. * (found->second / area - 1.) << " %).";
          log.warning(text.str());
        }
    }
  } // namespace

  mesh::TetMesh
  reference_mesh(const scene::Scene &scene, const mesh::TetMesh &initial_mesh, const core::Log &log)
  {
    const auto &parameters = scene.reference;
    if (parameters.route == scene::ReferenceParameters::MeshRoute::refine)
      return refined_mesh(scene, initial_mesh, log);
    log.progress("reference: making its mesh");
    mesh::TetMesh mesh
      = parameters.route == scene::ReferenceParameters::MeshRoute::bricks
          ? mesh::bricks(scene.mesh.lower_corner, scene.mesh.upper_corner, parameters.cells)
          : io::read_volume_mesh(parameters.file, log);
    mesh.kept = mesh::places_on_vertices(mesh, mesh::kept_places(scene));
    mesh::report_straddled(mesh::select_faces(mesh, mesh::face_selectors(scene)), log);
    compare_selections(initial_mesh, mesh, log);
    return mesh;
  }
} // namespace tetradapt::compare
