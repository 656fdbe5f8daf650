// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/mesh_source.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/remeshing.h"
#include "tetradapt/geometry/surface_io.h"
#include "tetradapt/io/volume_reader.h"
#include "tetradapt/mesh/blocks.h"
#include "tetradapt/mesh/boundary_projection.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/face_selectors.h"
#include "tetradapt/mesh/kept_places.h"
#include "tetradapt/mesh/plc.h"
#include "tetradapt/mesh/selection.h"
#include "tetradapt/mesh/selection_cuts.h"
#include "tetradapt/mesh/size_function.h"
#include "tetradapt/mesh/tetgen.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::io
{
  using dealii::Point;

  namespace
  {
    /** Entry @p number of a list, or its only one. */
    template <typename T>
    const T &
    entry(const std::vector<T> &list, unsigned int number)
    {
      return list[list.size() == 1 ? 0 : number];
    }

    geometry::SurfaceMesh
    load_surface(const scene::MeshParameters &parameters,
                 const std::string           &file,
                 const core::Log             &log)
    {
      log.progress("reading " + file);
      geometry::SurfaceMesh surface = geometry::read_surface(file);
      if (parameters.surface_edge_length == 0.)
        return surface;
      log.progress("remeshing the surface");
      const auto remeshed
        = geometry::remesh(surface, parameters.surface_edge_length, parameters.feature_angle, file);
      std::ostringstream text;
      text << "Surface " << file << ": " << surface.triangles.size() << " triangles remeshed to "
           << remeshed.surface.mesh.triangles.size() << " with edges of about "
           << remeshed.edge_length << "; its volume changed by " << 100. * remeshed.volume_change
           << " %";
      log.info(text.str());
      if (!remeshed.kept_features)
        log.warning(file + ": sharp edges could not be kept by the remeshing.");
      return remeshed.surface.mesh;
    }

    /** Volumes and their squares must stay within double precision, or energies
     * vanish without a word. */
    void
    check_extent(const mesh::TetMesh &mesh)
    {
      double extent = 0.;
      for (const auto &point : mesh.points)
        extent = std::max(extent, point.distance(mesh.points.front()));
      if (extent >= 1e-40 && extent <= 1e40)
        return;
      std::ostringstream text;
      text << "The mesh has an extent of " << extent
           << "; 1e-40 to 1e40 can be computed with. Choose another unit of length.";
      throw core::InputError(text.str());
    }

    /** What tells mesh @p number of a list from the others. */
    std::string
    mesh_name(const scene::Scene &scene, const unsigned int number)
    {
      const scene::MeshParameters &parameters = scene.mesh;
      if (parameters.source == scene::MeshSource::bricks)
        {
          const auto &n = entry(parameters.cells, number);
          return "of " + std::to_string(n[0]) + "x" + std::to_string(n[1]) + "x"
                 + std::to_string(n[2]) + " bricks";
        }
      if (parameters.files.size() > 1)
        return "'" + parameters.files[number] + "'";
      std::ostringstream text;
      text << "with Volume bound " << entry(parameters.volume_bounds, number);
      return text.str();
    }



    /** The edge length that is wanted at a point of the body: by Mesh/Size, by the bound on
     * volumes, and a tenth of the body at most. */
    std::function<double(const Point<3> &)>
    wanted_size(const scene::MeshParameters        &parameters,
                const mesh::PiecewiseLinearComplex &plc,
                const double                        max_volume)
    {
      mesh::TetMesh points;
      points.points             = plc.points;
      const auto [lower, upper] = mesh::bounding_box(points);
      double size               = 0.1 * lower.distance(upper);
      // The edge of a regular tetrahedron.
      if (max_volume > 0.)
        size = std::min(size, std::cbrt(6. * std::sqrt(2.) * max_volume));
      if (parameters.size.empty())
        return [size](const Point<3> &) { return size; };
      return [size, wanted = core::Expression(parameters.size, "Mesh/Size")](const Point<3> &p) {
        return std::min(size, wanted(p));
      };
    }

    /** The mesh of a body whose selections are cut into its surface. */
    mesh::TetMesh
    mesh_with_selections(const scene::Scene                 &scene,
                         const mesh::PiecewiseLinearComplex &plc,
                         const mesh::Sizing                 &sizing,
                         const mesh::BoundaryProjection     *projection,
                         const core::Log                    &log)
    {
      const auto selectors = mesh::face_selectors(scene);
      const auto places    = mesh::kept_places(scene);
      const auto size      = wanted_size(scene.mesh, plc, sizing.max_volume);
      // Corners of the pieces of a facet do not lie on the surface that the facet's lie on.
      const bool assign_first
        = projection != nullptr
          && (!places.empty()
              || mesh::with_selections(plc, selectors, size, core::Log()).points.size()
                   != plc.points.size());
      const auto whole
        = assign_first
            ? mesh::with_split_patches(plc,
                                       [&](mesh::TetMesh &faces) { projection->assign(faces); })
            : plc;
      const auto cut = mesh::with_kept_places(mesh::with_selections(whole, selectors, size, log),
                                              places,
                                              projection,
                                              log);
      mesh::TetgenReport  report;
      const mesh::TetMesh mesh = mesh::Tetgen(scene.tetgen).mesh(cut, sizing, &report);
      mesh::warn_of_unmet_wishes(report, log);
      return mesh;
    }

    /** What TetGen is to mesh for a scene's box, blocks or surface. */
    mesh::PiecewiseLinearComplex
    body_to_mesh(const scene::MeshParameters &parameters,
                 const unsigned int           number,
                 const core::Log             &log)
    {
      if (parameters.source == scene::MeshSource::box)
        return mesh::box_complex(parameters.lower_corner, parameters.upper_corner);
      if (parameters.source == scene::MeshSource::blocks)
        return mesh::blocks_complex(mesh::BlockGrid(parameters.blocks), parameters.block_regions);
      const std::string &file = entry(parameters.files, number);
      return mesh::surface_complex(load_surface(parameters, file, log), file);
    }

    mesh::TetMesh
    first_mesh(const scene::Scene             &scene,
               unsigned int                    number,
               const mesh::BoundaryProjection *projection,
               const core::Log                &log)
    {
      const scene::MeshParameters &parameters = scene.mesh;
      mesh::Sizing                 sizing;
      if (!parameters.volume_bounds.empty())
        sizing.max_volume = entry(parameters.volume_bounds, number);
      switch (parameters.source)
        {
        case scene::MeshSource::bricks:
          {
            mesh::TetMesh mesh = mesh::bricks(parameters.lower_corner,
                                              parameters.upper_corner,
                                              entry(parameters.cells, number));
            mesh.kept          = mesh::places_on_vertices(mesh, mesh::kept_places(scene));
            return mesh;
          }
        case scene::MeshSource::box:
        case scene::MeshSource::blocks:
          return mesh_with_selections(
            scene, body_to_mesh(parameters, number, log), sizing, projection, log);
        case scene::MeshSource::surface:
          {
            const auto body = body_to_mesh(parameters, number, log);
            log.progress("TetGen meshes the surface");
            return mesh_with_selections(scene, body, sizing, projection, log);
          }
        case scene::MeshSource::file:
          {
            const std::string &file = entry(parameters.files, number);
            log.progress("reading " + file);
            mesh::TetMesh mesh = read_volume_mesh(file, log);
            mesh.kept          = mesh::places_on_vertices(mesh, mesh::kept_places(scene));
            // New points would lie on no curved surface.
            if (projection != nullptr)
              projection->assign(mesh);
            if (sizing.max_volume <= 0.)
              return mesh;
            mesh::TetgenReport  report;
            const mesh::TetMesh refined = mesh::Tetgen(scene.tetgen).refine(mesh, sizing, &report);
            mesh::warn_of_unmet_wishes(report, log);
            return refined;
          }
        }
      return {};
    }
  } // namespace

  void
  check_kept_places(const scene::Scene &scene, const unsigned int number, scene::Mistakes &mistakes)
  {
    const auto places = mesh::kept_places(scene);
    if (places.empty() || !mesh::borders_are_cut(scene.mesh))
      return;
    mesh::PiecewiseLinearComplex body;
    const auto                   projection = mesh::make_projection(scene);
    if (!mistakes.attempt([&]() {
          body = body_to_mesh(scene.mesh, number, core::Log());
          if (projection != nullptr)
            body = mesh::with_split_patches(body, [&](mesh::TetMesh &faces) {
              projection->assign(faces);
            });
        }))
      return;
    for (const mesh::KeptPlace &place : places)
      mistakes.attempt([&]() { mesh::with_kept_places(body, {place}, projection.get()); });
  }

  mesh::TetMesh
  make_mesh(const scene::Scene &scene, unsigned int number, const core::Log &log)
  {
    const auto    projection = mesh::make_projection(scene);
    mesh::TetMesh mesh       = first_mesh(scene, number, projection.get(), log);
    check_extent(mesh);
    if (projection != nullptr)
      {
        if (scene.mesh.source != scene::MeshSource::file)
          projection->assign(mesh);
        projection->project(mesh);
      }
    if (!scene.mesh.size.empty())
      {
        log.progress("TetGen refines to Mesh/Size");
        mesh::SizeReport report;
        mesh
          = mesh::mesh_with_size(mesh::Tetgen(mesh::quality_for_projection(scene.tetgen,
                                                                           projection != nullptr)),
                                 mesh,
                                 core::Expression(scene.mesh.size, "Mesh/Size"),
                                 &report,
                                 mesh::project_on(projection.get()));
        if (report.cap_reached)
          log.warning("TetGen/Steiner points stopped the refinement to Mesh/Size: "
                      + std::to_string(report.oversized_cells)
                      + " tetrahedra are larger than asked for.");
      }
    // What was cut has its selections from its surface.
    if (mesh::borders_are_cut(scene.mesh))
      return mesh;
    try
      {
        mesh::report_straddled(mesh::select_faces(mesh, mesh::face_selectors(scene)), log);
      }
    catch (const core::InputError &error)
      {
        // Selections that fit the first mesh may find nothing on a later one.
        if (scene.mesh.n_meshes() == 1)
          throw;
        throw core::InputError(error.what() + std::string(" (in the mesh ")
                               + mesh_name(scene, number) + ", number " + std::to_string(number + 1)
                               + " of " + std::to_string(scene.mesh.n_meshes()) + ")");
      }
    return mesh;
  }
} // namespace tetradapt::io
