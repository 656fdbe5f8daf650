// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_red_refinement_h
#define tetradapt_mesh_red_refinement_h

#include "tetradapt/mesh/edges.h"

namespace tetradapt::mesh
{
  /**
   * Every tetrahedron of @p mesh cut into eight: one at each corner, and four
   * around the shortest of the three diagonals of the octahedron that remains
   * (Bey, Computing 55, 1995; the first of equally short ones).
   *
   * The old points stay first; the middle of edge e of build_edges() is point
   * n_points() + e. Cell c becomes the cells 8c .. 8c+7, face f the faces 4f ..
   * 4f+3. Regions, patches and names are inherited. The mesh must be finalized,
   * and so is the result.
   *
   * @param edges the edges of @p mesh, if they are at hand; else they are made.
   * @throws core::InputError if the result has too many cells to be numbered.
   */
  TetMesh
  red_refine(const TetMesh &mesh, const EdgeTable *edges = nullptr);
} // namespace tetradapt::mesh

#endif
