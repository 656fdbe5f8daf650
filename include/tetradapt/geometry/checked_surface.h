// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_geometry_checked_surface_h
#define tetradapt_geometry_checked_surface_h

#include "tetradapt/geometry/surface_mesh.h"

#include <string>

namespace tetradapt::geometry
{
  /** A surface that a volume can be filled into, and what had to be done to it. */
  struct CheckedSurface
  {
    SurfaceMesh  mesh;                  ///< closed, its triangles counter-clockwise from outside
    double       volume           = 0.; ///< enclosed
    double       area             = 0.;
    unsigned int n_components     = 0; ///< parts that do not touch
    unsigned int dropped_points   = 0; ///< named by no triangle
    unsigned int turned_triangles = 0; ///< had their inside out
  };

  /**
   * Checks that a surface is a valid input for a mesher: finite coordinates,
   * point numbers in range, no two points or triangles the same, no degenerate
   * triangle, each edge in exactly two triangles (closed, manifold), the triangles
   * around a point one fan, no self-intersection, a volume that is not nearly
   * zero. Points that no triangle names are dropped; the orientation is made
   * outward if a consistent one exists. Several parts are allowed next to each other.
   *
   * CGAL (Polygon Mesh Processing) finds self-intersections, with exact predicates.
   *
   * @param what names the surface at the beginning of messages.
   * @throws InputError with the numbers (counted from 0) and coordinates of the
   *         first offenders, how many there are, and what to do.
   */
  CheckedSurface
  check_surface(const SurfaceMesh &surface, const std::string &what);
} // namespace tetradapt::geometry

#endif
