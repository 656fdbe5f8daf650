// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_bricks_h
#define tetradapt_mesh_bricks_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::mesh
{
  /**
   * An axis-parallel box cut into n[0] x n[1] x n[2] equal bricks, each cut into
   * the six tetrahedra around its main diagonal (Kuhn, Freudenthal), which is
   * conforming and the same in every brick.
   *
   * Points, (n[0]+1)(n[1]+1)(n[2]+1) of them, and bricks are numbered along x
   * first, then y, then z. The boundary ids 1 to 6 are named x-min, x-max, y-min,
   * y-max, z-min, z-max; the region is 0. The mesh is as finalize() leaves it.
   *
   * @throws core::InputError if a number is zero, the box is empty or inverted,
   *         coordinates are not finite or too close for their digits, or the
   *         mesh would be too large to number.
   */
  TetMesh
  bricks(const Point<3> &lower, const Point<3> &upper, const std::array<unsigned int, 3> &n);
} // namespace tetradapt::mesh

#endif
