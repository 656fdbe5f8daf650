// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_geometry_border_curves_h
#define tetradapt_source_geometry_border_curves_h

#include "flat_part_search.h"

#include "tetradapt/core/condition_leaf.h"

namespace tetradapt::geometry
{
  /** Lengths that all cuts of a body share. */
  struct CutScale
  {
    explicit CutScale(const SurfaceMesh &surface);

    double snap;    ///< points as near as this are one
    double spacing; ///< of the points at which borders are looked for

    /** The spacing for one leaf. */
    double
    spacing_for(const core::ConditionLeaf &leaf) const;
  };

  /** A piece of a border in a flat part. */
  struct BorderCurve
  {
    std::vector<Point<3>> points; ///< in order; a closed one ends where it begins
    bool                  closed = false;
  };

  /** A flat part of a surface, with the surface. */
  struct PartOfSurface
  {
    const SurfaceMesh  &surface;
    const FlatPartList &parts;
    unsigned int        number;

    const Tensor<1, 3> &
    normal() const
    {
      return parts.normals[number];
    }
    const std::vector<unsigned int> &
    triangles() const
    {
      return parts.triangles[number];
    }
    const std::vector<OutlineSide> &
    outline() const
    {
      return parts.outlines[number];
    }
    double
    longest_edge() const;
    /** Whether @p point, which is in its plane, lies in one of its triangles, and farther
     * than @p tolerance from its outline. */
    bool
    contains(const Point<3> &point, double tolerance) const;
    /** The point of the outline's side @p side that is nearest to @p point. */
    Point<3>
    foot(const OutlineSide &side, const Point<3> &point) const;
    /** Distance of @p point from the outline's side @p side. */
    double
    distance(const OutlineSide &side, const Point<3> &point) const;
  };

  /**
   * Where a leaf's level changes its sign in a flat part: pieces of straight lines for an
   * affine leaf, else polylines with points on the border at about the scale's spacing.
   *
   * @param levels of the leaf at the surface's points.
   */
  std::vector<BorderCurve>
  border_curves(const PartOfSurface       &part,
                const core::ConditionLeaf &leaf,
                const std::vector<double> &levels,
                const CutScale            &scale);

  /** The parameter of [0, 1] at which @p holds changes from its value at 0, by bisection. */
  template <typename Holds>
  double
  change_of(const Holds &holds)
  {
    double     from = 0., to = 1.;
    const bool first = holds(0.);
    for (unsigned int step = 0; step < 50; ++step)
      {
        const double middle                  = .5 * (from + to);
        (holds(middle) == first ? from : to) = middle;
      }
    return .5 * (from + to);
  }
} // namespace tetradapt::geometry

#endif
