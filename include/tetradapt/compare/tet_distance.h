// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_tet_distance_h
#define tetradapt_compare_tet_distance_h

#include <deal.II/base/point.h>

#include <array>

namespace tetradapt::compare
{
  using dealii::Point;

  /** The point of a triangle that is closest to a given one. */
  struct ClosestPoint
  {
    std::array<double, 3> weights{{1., 0., 0.}}; ///< barycentric, >= 0, sum 1
    double                squared_distance = 0.;
  };

  /**
   * Closest point to @p p of the triangle @p a, @p b, @p c: its projection onto
   * the plane if that lies inside, else the closest of the three edges' closest
   * points. Right for triangles that are degenerate to an edge or a point also.
   */
  ClosestPoint
  closest_point_on_triangle(const Point<3> &p,
                            const Point<3> &a,
                            const Point<3> &b,
                            const Point<3> &c);
} // namespace tetradapt::compare

#endif
