// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_thin_parts_h
#define tetradapt_mesh_thin_parts_h

#include "tetradapt/mesh/tet_mesh.h"

#include <vector>

namespace tetradapt::mesh
{
  /**
   * The cells where the body is fewer than four elements thick. A point is deep if
   * neither it nor one of its neighbours lies on the boundary: between it and any wall there are
   * two edges at least. The cells that are not within a few edges of a deep point are the
   * thin ones. Takes a few sweeps over the cells.
   *
   * @return one a cell.
   */
  std::vector<bool>
  thin_parts(const TetMesh &mesh);
} // namespace tetradapt::mesh

#endif
