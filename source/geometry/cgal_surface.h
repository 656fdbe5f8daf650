// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_geometry_cgal_surface_h
#define tetradapt_geometry_cgal_surface_h

#include "tetradapt/geometry/surface_mesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

// Included by the few source files of this room that use CGAL, which is slow to
// compile; never by a public header.
namespace tetradapt::geometry
{
  using CgalKernel  = CGAL::Exact_predicates_inexact_constructions_kernel;
  using CgalPoint   = CgalKernel::Point_3;
  using CgalSurface = CGAL::Surface_mesh<CgalPoint>;

  /**
   * The surface as CGAL's half-edge structure; points and triangles keep their
   * numbers.
   *
   * @throws InputError if the triangles do not form an oriented manifold; run
   *         check_surface() before.
   */
  CgalSurface
  to_cgal(const SurfaceMesh &surface);

  /**
   * Replaces triangles that intersect others, and their surroundings, until no
   * two intersect (CGAL's remove_self_intersections, which is experimental).
   * Property maps have their default values on new triangles.
   *
   * @return whether it succeeded; if not, the surface may be partly repaired.
   */
  bool
  remove_self_intersections(CgalSurface &surface);
} // namespace tetradapt::geometry

#endif
