// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/tetgen_result.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::mesh
{
  namespace
  {
    using core::NumericalError;

    /** What to do when TetGen's mesh is not what was asked for. */
    constexpr char advice[]
      = " Change the wanted size or TetGen's quality bounds slightly, or repair the input.";

    void
    copy_cells(TetMesh &mesh, const TetgenReply &reply)
    {
      mesh.points.reserve(reply.points.size() / 3);
      for (std::size_t i = 0; i + 2 < reply.points.size(); i += 3)
        mesh.points.emplace_back(reply.points[i], reply.points[i + 1], reply.points[i + 2]);
      mesh.cells.resize(reply.tets.size() / 4);
      for (std::size_t i = 0; i < reply.tets.size(); ++i)
        mesh.cells[i / 4][i % 4] = reply.tets[i];
      mesh.regions.assign(mesh.cells.size(), 0);
      if (reply.tet_attributes.size() == mesh.cells.size())
        for (std::size_t i = 0; i < mesh.cells.size(); ++i)
          mesh.regions[i] = static_cast<int>(std::lround(reply.tet_attributes[i]));
    }

  } // namespace

  TetMesh
  mesh_from_reply(const TetgenReply        &reply,
                  const std::vector<Patch> &patches,
                  const std::string        &what)
  {
    if (reply.tets.empty())
      throw NumericalError("TetGen made no tetrahedra in " + what
                           + ". Its boundary may have a gap that rounding hides: repair it.");
    TetMesh mesh;
    copy_cells(mesh, reply);
    mesh.patches = patches;
    for (std::size_t i = 0; i < reply.face_markers.size(); ++i)
      {
        const std::int32_t marker = reply.face_markers[i];
        if (marker < 1 || static_cast<std::size_t>(marker) > patches.size())
          continue;
        BoundaryFace face;
        for (unsigned int j = 0; j < 3; ++j)
          face.vertices[j] = reply.faces[3 * i + j];
        face.patch = marker - 1;
        mesh.faces.push_back(face);
      }

    FinalizeReport report;
    try
      {
        report = finalize(mesh, "TetGen's mesh of " + what);
      }
    catch (const core::InputError &error)
      {
        throw NumericalError(error.what() + std::string(advice));
      }
    if (report.added_faces > 0)
      throw NumericalError("TetGen lost the boundary id of " + std::to_string(report.added_faces)
                           + " boundary faces of " + what + '.' + advice);
    return mesh;
  }

  double
  check_kept(const MeshTotals  &before,
             const MeshTotals  &after,
             double             tolerance,
             const std::string &what)
  {
    const auto complaints = compare_totals(before, after, tolerance);
    if (!complaints.empty())
      {
        std::string message = "TetGen's mesh of " + what + " is not what was asked for: ";
        for (std::size_t i = 0; i < std::min<std::size_t>(complaints.size(), 3); ++i)
          message += (i > 0 ? "; " : "") + complaints[i];
        if (complaints.size() > 3)
          message += "; and " + std::to_string(complaints.size() - 3) + " more";
        throw NumericalError(message + '.' + advice);
      }
    return std::abs(after.volume - before.volume) / before.volume;
  }
} // namespace tetradapt::mesh
