// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_geometry_axis_plane_h
#define tetradapt_source_geometry_axis_plane_h

#include <deal.II/base/point.h>

#include <array>
#include <cmath>

namespace tetradapt::geometry
{
  /** Turns points into the coordinates of a plane that looks along an axis. */
  class AxisPlane
  {
  public:
    explicit AxisPlane(const dealii::Tensor<1, 3> &normal) : normal(normal)
    {
      for (unsigned int k = 1; k < 3; ++k)
        if (std::abs(normal[k]) > std::abs(normal[axis]))
          axis = k;
      first  = (axis + 1) % 3;
      second = (axis + 2) % 3;
      if (normal[axis] < 0.)
        std::swap(first, second);
    }

    std::array<double, 2>
    operator()(const dealii::Point<3> &p) const
    {
      return {{p[first], p[second]}};
    }

    /** The point with the coordinates @p uv in the plane through @p origin. */
    dealii::Point<3>
    lift(const std::array<double, 2> &uv, const dealii::Point<3> &origin) const
    {
      dealii::Point<3> p;
      p[first]  = uv[0];
      p[second] = uv[1];
      p[axis]
        = origin[axis]
          - (normal[first] * (uv[0] - origin[first]) + normal[second] * (uv[1] - origin[second]))
              / normal[axis];
      return p;
    }

  private:
    dealii::Tensor<1, 3> normal;
    unsigned int         axis = 0, first, second;
  };
} // namespace tetradapt::geometry

#endif
