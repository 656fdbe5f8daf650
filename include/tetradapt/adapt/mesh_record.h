// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_mesh_record_h
#define tetradapt_adapt_mesh_record_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/compare/point_locator.h"
#include "tetradapt/mesh/point_moves.h"

namespace tetradapt::adapt
{
  /** Shape, totals and volume of @p mesh. About 0.2 s for a million cells.
   * @param first_volume of the run's first mesh. */
  void
  describe_mesh(const mesh::TetMesh &mesh, double first_volume, MeshRecord &record);

  /** What projecting the boundary did. */
  void
  describe_moves(const mesh::MoveReport &moves, MeshRecord &record);

  /**
   * Cells of @p mesh whose equivalent edge is more than twice the wanted size at their
   * centroid, which is linear in each cell of the mesh that it was wanted on. About
   * 0.6 s for a million cells.
   *
   * @param locator of the mesh that the sizes belong to.
   * @param node_sizes one a point of that mesh.
   */
  unsigned long
  count_oversized_tets(const mesh::TetMesh         &mesh,
                       const compare::PointLocator &locator,
                       const std::vector<double>   &node_sizes);

  /** The edge length that @p mesh has at each point: the geometric mean of the
   * equivalent edges around it, weighted by volume. */
  std::vector<double>
  obtained_sizes(const mesh::TetMesh &mesh);
} // namespace tetradapt::adapt

#endif
