// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/condition_leaf.h"

#include "tetradapt/core/exceptions.h"

namespace tetradapt::core
{
  double
  ConditionLeaf::level(const Point<3> &point, const double t) const
  {
    switch (kind)
      {
      case Kind::affine:
        return normal * Tensor<1, 3>(point) - offset;
      case Kind::sphere:
        return (point - center).norm() - radius;
      case Kind::cylinder:
        {
          const Tensor<1, 3> arm = point - center;
          return (arm - (arm * normal) * normal).norm() - radius;
        }
      case Kind::constant:
        return offset;
      case Kind::general:
        try
          {
            return (*difference)(point, t);
          }
        catch (const InputError &)
          {
          }
        [[fallthrough]];
      default:
        return truth->holds(point, t) ? -1. : 1.;
      }
  }
} // namespace tetradapt::core
