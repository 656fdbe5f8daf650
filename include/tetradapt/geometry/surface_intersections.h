// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_geometry_surface_intersections_h
#define tetradapt_geometry_surface_intersections_h

#include "tetradapt/geometry/surface_mesh.h"

#include <utility>

namespace tetradapt::geometry
{
  /**
   * All pairs of triangles of a closed manifold surface that cross, touch or
   * overlap without sharing the edge or the point where they meet; in increasing
   * order. By CGAL's exact predicates.
   */
  std::vector<std::pair<unsigned int, unsigned int>>
  self_intersections(const SurfaceMesh &surface);

  /** Whether @p point lies inside a closed manifold surface that does not
   * intersect itself. */
  bool
  encloses(const SurfaceMesh &surface, const Point<3> &point);
} // namespace tetradapt::geometry

#endif
