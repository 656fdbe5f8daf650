// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_mesh_summary_h
#define tetradapt_report_mesh_summary_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/mesh/tet_mesh.h"

#include <string>

namespace tetradapt::report
{
  /** "1071 points, 3456 tetrahedra, dihedral angles 10.2 to 158 degrees": one
   * line for the log, cheap enough for every cycle.
   * @param record of this mesh: has the angles. */
  std::string
  mesh_line(const mesh::TetMesh &mesh, const adapt::MeshRecord &record);

  /**
   * What a finalized mesh consists of, several lines for the log: counts, the
   * box around it, volume and area; each region; each patch of the boundary
   * with what acts on it; the shape of the cells and where the worst one lies.
   * Without an end of line.
   */
  std::string
  mesh_summary(const mesh::TetMesh &mesh);
} // namespace tetradapt::report

#endif
