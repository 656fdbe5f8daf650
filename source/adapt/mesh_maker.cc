// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/mesh_maker.h"

#include "tetradapt/adapt/saved_sizes.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/on_first_rank.h"
#include "tetradapt/io/mesh_source.h"
#include "tetradapt/mesh/body_complex.h"
#include "tetradapt/mesh/boundary_projection.h"
#include "tetradapt/mesh/face_table.h"
#include "tetradapt/mesh/mesh_broadcast.h"
#include "tetradapt/mesh/red_refinement.h"

#include <algorithm>
#include <sstream>

namespace tetradapt::adapt
{
  MeshMaker::MeshMaker(const scene::Scene &scene, MPI_Comm communicator, const core::Log &log)
    : scene(scene), communicator(communicator), log(log),
      tetgen(mesh::quality_for_projection(scene.tetgen,
                                          scene.mesh.projection
                                            != scene::MeshParameters::Projection::none))
  {
    core::on_first_rank(communicator, [&]() { projection = mesh::make_projection(scene); });
  }

  NewMesh
  MeshMaker::make(const std::function<mesh::TetMesh(NewMesh &)> &how, const bool project)
  {
    NewMesh made;
    made.mesh = mesh::make_on_first_rank(communicator, [&]() {
      mesh::TetMesh mesh = how(made);
      if (project && projection != nullptr)
        {
          const mesh::MoveReport moves = projection->project(mesh);
          describe_moves(moves, made.record);
          made.swept = moves.swept_volume / mesh::total_volume(mesh);
          if (moves.n_held > 0)
            log.warning(std::to_string(moves.n_held)
                        + " points of the boundary could not be moved to the body's surface "
                          "without spoiling a tetrahedron; the next mesh tries again.");
        }
      if (first_volume == 0.)
        {
          first_volume = mesh::total_volume(mesh);
          body_volume  = projection == nullptr ? first_volume : projection->body_volume(mesh);
        }
      describe_mesh(mesh, first_volume, made.record);
      made.record.n_parts     = n_parts;
      made.record.body_volume = body_volume;
      compare_with_true_volume(mesh);
      return mesh;
    });
    core::broadcast_bytes(&made.swept, sizeof(double), communicator);
    return made;
  }

  void
  MeshMaker::compare_with_true_volume(const mesh::TetMesh &mesh) const
  {
    if (projection == nullptr || projection->true_volume() == 0.)
      return;
    std::ostringstream text;
    text << "The mesh's volume differs from that inside the surface by "
         << 100. * (mesh::total_volume(mesh) / projection->true_volume() - 1.) << " %";
    log.detail(text.str());
  }

  mesh::TetMesh
  MeshMaker::initial_mesh(const unsigned int number, NewMesh &made)
  {
    mesh::TetMesh mesh  = io::make_mesh(scene, number, log);
    const auto    parts = mesh::connected_components(mesh);
    n_parts             = 1 + *std::max_element(parts.begin(), parts.end());
    if (scene.mesh.size_field.empty())
      return mesh;
    log.progress("TetGen refines to Mesh/Size field");
    mesh::MoveReport moves;
    mesh::MeshChange change;
    mesh::SizeReport report;
    const SavedSizes sizes(scene.mesh.size_field);
    if (projection != nullptr)
      change = [&](mesh::TetMesh &refined) { moves = projection->project(refined); };
    mesh = mesh_with_saved_sizes(tetgen, mesh, sizes, change, &report);
    describe_moves(moves, made.record);
    made.record.requested_tets = sizes.n_cells();
    std::ostringstream text;
    text << "The sizes of " << scene.mesh.size_field << ", of " << sizes.n_cells()
         << " tetrahedra, gave " << mesh.n_cells() << " in " << report.passes << " passes";
    log.detail(text.str());
    if (report.cap_reached)
      log.warning("TetGen/Steiner points stopped the refinement to Mesh/Size field: "
                  + std::to_string(report.oversized_cells)
                  + " tetrahedra are larger than asked for.");
    return mesh;
  }

  NewMesh
  MeshMaker::initial(const unsigned int number)
  {
    return make([&](NewMesh &made) { return initial_mesh(number, made); }, false);
  }

  mesh::TetMesh
  MeshMaker::refine(const mesh::TetMesh &old, const SizeField &field) const
  {
    log.progress("TetGen refines " + std::to_string(old.n_cells()) + " tetrahedra");
    mesh::TetgenReport report;
    mesh::Sizing       sizing = field.sizing;
    // A projected boundary may be what TetGen fails on, here or there: with slightly
    // other points it often does not.
    for (unsigned int attempts_left = projection == nullptr ? 0 : 3;; --attempts_left)
      try
        {
          mesh::TetMesh mesh = tetgen.refine(old, sizing, &report);
          mesh::warn_of_unmet_wishes(report, log);
          return mesh;
        }
      catch (const core::NumericalError &error)
        {
          if (attempts_left == 0)
            throw;
          log.warning(error.what() + std::string(" Trying again with slightly smaller sizes."));
          for (double &size : sizing.node_sizes)
            size *= 0.95;
          for (double &volume : sizing.cell_volumes)
            volume *= 0.86;
        }
  }

  mesh::TetMesh
  MeshMaker::mesh_from_scratch(const mesh::TetMesh   &old,
                               const SizeField       &field,
                               const mesh::EdgeTable &edges) const
  {
    log.progress("TetGen meshes the body from scratch");
    try
      {
        const mesh::BodyComplex body = mesh::body_complex(old, field.node_sizes, edges);
        mesh::TetgenReport      report;
        mesh::TetMesh           mesh = tetgen.mesh(body.plc, body.sizing, &report);
        mesh::warn_of_unmet_wishes(report, log);
        mesh.region_names = old.region_names;
        return mesh;
      }
    catch (const std::runtime_error &error)
      {
        log.warning(
          "The body could not be meshed from scratch, so that its tetrahedra are refined only "
          "this time. "
          + std::string(error.what()));
      }
    return refine(old, field);
  }

  NewMesh
  MeshMaker::refined(const mesh::TetMesh         &old,
                     const SizeField             &field,
                     const compare::PointLocator &locator)
  {
    return make(
      [&](NewMesh &made) {
        mesh::TetMesh mesh         = refine(old, field);
        made.record.requested_tets = field.predicted_tets;
        made.record.oversized_tets = count_oversized_tets(mesh, locator, field.node_sizes);
        return mesh;
      },
      true);
  }

  NewMesh
  MeshMaker::made_from_scratch(const mesh::TetMesh         &old,
                               const SizeField             &field,
                               const compare::PointLocator &locator,
                               const mesh::EdgeTable       &edges)
  {
    return make(
      [&](NewMesh &made) {
        mesh::TetMesh mesh         = mesh_from_scratch(old, field, edges);
        made.record.requested_tets = field.predicted_tets;
        made.record.oversized_tets = count_oversized_tets(mesh, locator, field.node_sizes);
        return mesh;
      },
      true);
  }

  NewMesh
  MeshMaker::uniform(const mesh::TetMesh &old, const mesh::EdgeTable *edges)
  {
    return make(
      [&](NewMesh &made) {
        made.record.requested_tets = 8. * old.n_cells();
        return mesh::red_refine(old, edges);
      },
      true);
  }
} // namespace tetradapt::adapt
