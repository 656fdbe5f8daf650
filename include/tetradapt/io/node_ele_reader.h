// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_node_ele_reader_h
#define tetradapt_io_node_ele_reader_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::io
{
  /**
   * Reads TetGen's files x.node, x.ele and, if there is one, x.face; @p file names
   * any of them. The first attribute of a tetrahedron, a whole number, is its
   * region; markers of faces are boundary ids. Points are counted from 0 or 1, as
   * the first one says. Tetrahedra with ten nodes (-o2) must be straight. The
   * result still needs finalize().
   *
   * Format: TetGen 1.5 user's manual, chapter 5.
   */
  mesh::TetMesh
  read_node_ele(const std::string &file);
} // namespace tetradapt::io

#endif
