// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_msh_reader_h
#define tetradapt_io_msh_reader_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::io
{
  /**
   * Reads a Gmsh file, format 2.0 to 2.2 or 4.1, ASCII or binary. Physical
   * surfaces become boundary ids and named groups, physical volumes regions; an
   * element outside every physical group gets 0. Tetrahedra may be of first
   * or second order (see MeshBuilder::add_quadratic_cell()); points and lines are
   * left out, other elements refused. The result still needs finalize().
   *
   * Format: Gmsh reference manual, "MSH file format".
   */
  mesh::TetMesh
  read_msh(const std::string &file);
} // namespace tetradapt::io

#endif
