// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/selectors.h"

#include <algorithm>

namespace tetradapt::core
{
  namespace
  {
    void
    require(const bool condition, const char *message)
    {
      if (!condition)
        throw SelectorError(message);
    }
  } // namespace

  bool
  in_box(const Point<3> &p, const Point<3> &corner, const Point<3> &opposite)
  {
    for (unsigned int d = 0; d < 3; ++d)
      if (p[d] < std::min(corner[d], opposite[d]) || p[d] > std::max(corner[d], opposite[d]))
        return false;
    return true;
  }

  bool
  in_sphere(const Point<3> &p, const Point<3> &center, const double radius)
  {
    require(radius >= 0., "the radius of a sphere must not be negative.");
    return (p - center).norm_square() <= radius * radius;
  }

  bool
  in_cylinder(const Point<3> &p, const Point<3> &begin, const Point<3> &end, const double radius)
  {
    require(radius >= 0., "the radius of a cylinder must not be negative.");
    const double length = (end - begin).norm();
    require(length > 0., "the two ends of a cylinder's axis must differ.");
    const Tensor<1, 3> axis  = (end - begin) / length;
    const double       along = (p - begin) * axis;
    return along >= 0. && along <= length
           && ((p - begin) - along * axis).norm_square() <= radius * radius;
  }

  bool
  in_half_space(const Point<3> &p, const Point<3> &origin, const Tensor<1, 3> &normal)
  {
    require(normal.norm() > 0., "the normal of a half space must not be zero.");
    return (p - origin) * normal <= 0.;
  }
} // namespace tetradapt::core
