// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_point_moves_h
#define tetradapt_mesh_point_moves_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::mesh
{
  /** A point of a mesh and where it is to go. */
  struct PointMove
  {
    unsigned int point;
    Point<3>     target;
  };

  /** What move_points() did. */
  struct MoveReport
  {
    unsigned long n_moved    = 0;  ///< points that arrived
    unsigned long n_held     = 0;  ///< points that had to stop on the way
    unsigned long n_smoothed = 0;  ///< points inside that made way
    double        farthest   = 0.; ///< longest way that a point went
    /** Volume that the boundary swept, whatever its sign. */
    double swept_volume = 0.;
  };

  /**
   * Mean ratio of a tetrahedron, 12 (3 V)^(2/3) over the sum of its squared edge
   * lengths: 1 for a regular one, 0 for a flat one, negative for an inverted one (A. Liu,
   * B. Joe, BIT 34, 1994).
   */
  double
  mean_ratio(const Point<3> &a, const Point<3> &b, const Point<3> &c, const Point<3> &d);

  /**
   * Moves points of the boundary to their targets as far as every cell stays good: its
   * mean ratio must not fall below half of what it was, or below 0.2 if that is less.
   * Points inside near one that goes far are taken along by the mean of the ways around
   * them. Where a cell would still become bad, points inside around it are moved to where
   * the cells around them are best; what does not help is taken back by halving the way
   * of the cell's moving points, down to nothing. Points between regions stay. The mesh
   * must be finalized, and is so after.
   */
  MoveReport
  move_points(TetMesh &mesh, const std::vector<PointMove> &moves);
} // namespace tetradapt::mesh

#endif
