// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_preview_h
#define tetradapt_report_preview_h

#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/scene.h"

#include <string>

namespace tetradapt::report
{
  /**
   * Tables of where a scene acts on a mesh: of each support, load and goal on faces the number of
   * faces, their area and its centre; of each load on the body and each material the number of
   * tetrahedra and their volume; of each boundary id its name, faces and area.
   *
   * @param mesh a mesh of @p scene, with the scene's selections on its patches.
   * @throws core::InputError for a region that the mesh does not have.
   */
  std::string
  preview_tables(const scene::Scene &scene, const mesh::TetMesh &mesh);

  /**
   * Writes the surface of a mesh for ParaView (.vtu, triangles). Each has the numbers "patch",
   * "boundary_id", "region" and "material" (the last two of the tetrahedron behind it), its
   * "area", and for each support, load and goal, under its name ("Supports/foot"), 1 where it
   * acts and 0 elsewhere. The names of boundary ids, regions and materials are texts of the whole
   * file ("boundary_names", ...), a line "id name" each.
   *
   * @param mesh as in preview_tables().
   * @throws as io::VtuWriter::write() and preview_tables() do.
   */
  void
  write_preview(const std::string &file, const scene::Scene &scene, const mesh::TetMesh &mesh);
} // namespace tetradapt::report

#endif
