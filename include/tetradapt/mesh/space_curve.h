// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_space_curve_h
#define tetradapt_mesh_space_curve_h

#include <deal.II/base/point.h>

#include <cstdint>
#include <vector>

namespace tetradapt::mesh
{
  using dealii::Point;

  /**
   * Numbers along the Morton (Z) curve through a cube: points that are close on
   * the curve are close in space, so that work done in this order finds its data
   * in the processor's caches. 21 bits a direction: a graded mesh whose smallest
   * cells are 1e-6 of its size is still ordered inside its finest part.
   */
  class SpaceCurve
  {
  public:
    /** A curve through the smallest cube around the box @p lower, @p upper. */
    SpaceCurve(const Point<3> &lower, const Point<3> &upper);

    /** Position of @p point on the curve; points outside are moved to the cube. */
    std::uint64_t
    operator()(const Point<3> &point) const;

    /** Numbers of @p points, sorted along the curve; equal positions by number. */
    std::vector<unsigned int>
    order(const std::vector<Point<3>> &points) const;

  private:
    Point<3> origin;
    double   scale;
  };
} // namespace tetradapt::mesh

#endif
