// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_selectors_h
#define tetradapt_core_selectors_h

#include "tetradapt/core/exceptions.h"

#include <deal.II/base/point.h>

namespace tetradapt::core
{
  using dealii::Point;
  using dealii::Tensor;

  /** There is no such solid; the message says why, but not where it was asked for. */
  class SelectorError : public InputError
  {
  public:
    using InputError::InputError;
  };

  /**
   * The solids that expressions know by name. Their surfaces belong to them.
   * Each throws SelectorError if there is no such solid: a negative radius, an axis
   * or a normal of length zero.
   */
  bool
  in_box(const Point<3> &p, const Point<3> &corner, const Point<3> &opposite);

  bool
  in_sphere(const Point<3> &p, const Point<3> &center, double radius);

  /** The solid cylinder around the segment from @p begin to @p end. */
  bool
  in_cylinder(const Point<3> &p, const Point<3> &begin, const Point<3> &end, double radius);

  /** The points with (p - @p origin) . @p normal <= 0. */
  bool
  in_half_space(const Point<3> &p, const Point<3> &origin, const Tensor<1, 3> &normal);
} // namespace tetradapt::core

#endif
