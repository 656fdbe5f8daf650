// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_tests_geometry_surfaces_h
#define tetradapt_tests_geometry_surfaces_h

#include "tetradapt/geometry/surface_mesh.h"

#include <cmath>

// Surfaces with known volumes and areas.
namespace surfaces
{
  using dealii::Point;
  using tetradapt::geometry::SurfaceMesh;

  /** A box of 12 triangles with the ids 1..6 of x-min to z-max, outward. */
  inline SurfaceMesh
  box(const Point<3> &lower, const Point<3> &upper)
  {
    SurfaceMesh surface;
    for (unsigned int i = 0; i < 8; ++i)
      surface.points.emplace_back((i & 1) ? upper[0] : lower[0],
                                  (i & 2) ? upper[1] : lower[1],
                                  (i & 4) ? upper[2] : lower[2]);
    const unsigned int sides[6][4]
      = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (unsigned int s = 0; s < 6; ++s)
      {
        surface.triangles.push_back({{sides[s][0], sides[s][1], sides[s][2]}});
        surface.triangles.push_back({{sides[s][0], sides[s][2], sides[s][3]}});
        surface.ids.insert(surface.ids.end(), 2, s + 1);
      }
    return surface;
  }

  inline SurfaceMesh
  unit_cube()
  {
    return box(Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  }

  /** Both surfaces in one. */
  inline SurfaceMesh
  join(const SurfaceMesh &a, const SurfaceMesh &b)
  {
    SurfaceMesh        result = a;
    const unsigned int shift  = a.points.size();
    result.points.insert(result.points.end(), b.points.begin(), b.points.end());
    for (const auto &t : b.triangles)
      result.triangles.push_back({{t[0] + shift, t[1] + shift, t[2] + shift}});
    result.ids.insert(result.ids.end(), b.ids.begin(), b.ids.end());
    return result;
  }
} // namespace surfaces

#endif
