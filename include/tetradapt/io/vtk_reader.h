// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_vtk_reader_h
#define tetradapt_io_vtk_reader_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::io
{
  /**
   * Reads an unstructured grid from a legacy VTK file (versions 1 to 5.1), ASCII
   * or binary. Which cells and which arrays are used: see mesh_of_grid() and
   * id_arrays(). The result still needs finalize().
   *
   * Format: "The VTK User's Guide", "Simple Legacy Formats".
   */
  mesh::TetMesh
  read_vtk(const std::string &file);
} // namespace tetradapt::io

#endif
