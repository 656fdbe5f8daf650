// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_volume_reader_h
#define tetradapt_io_volume_reader_h

#include "tetradapt/core/log.h"
#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::io
{
  /**
   * Reads a tetrahedral mesh, finalizes it and checks that it fills space once. The ending of the
   * name tells the format: .msh (read_msh()), .vtk (read_vtk()), .vtu (read_vtu()), .node, .ele or
   * .face (read_node_ele()).
   *
   * @throws core::InputError if the file does not exist, has another ending, is
   *         damaged (with the line or byte) or does not pass finalize() or
   *         check_embedding().
   * @param log gets the warnings of check_embedding().
   */
  mesh::TetMesh
  read_volume_mesh(const std::string &file, const core::Log &log = core::Log());
} // namespace tetradapt::io

#endif
