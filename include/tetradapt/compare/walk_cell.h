// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_walk_cell_h
#define tetradapt_compare_walk_cell_h

#include "tetradapt/compare/point_locator.h"

#include <algorithm>

namespace tetradapt::compare::internal
{
  /**
   * What one step of PointLocator's walk needs of a cell, in two cache lines:
   * the barycentric coordinates 1..3 are gradient . (p - origin). Differences are
   * formed first, so that a mesh far from the origin loses no digits.
   */
  struct alignas(64) WalkCell
  {
    double                      origin[3];
    double                      gradient[3][3];
    double                      margin; ///< tolerance / smallest height
    std::array<unsigned int, 4> neighbours;
    unsigned int                number; ///< in the mesh

    /** Fills origin, gradient and margin from the four vertices. A cell without
     * volume gets NaN, which makes every comparison with its coordinates false:
     * no point is in it. */
    void
    set_geometry(const std::array<const Point<3> *, 4> &vertices, double tolerance);

    mesh::Barycentric
    invert(const Point<3> &p) const
    {
      const double      x = p[0] - origin[0], y = p[1] - origin[1], z = p[2] - origin[2];
      mesh::Barycentric b;
      for (unsigned int i = 0; i < 3; ++i)
        b[i + 1] = gradient[i][0] * x + gradient[i][1] * y + gradient[i][2] * z;
      b[0] = 1. - b[1] - b[2] - b[3];
      return b;
    }

    /** Distance of vertex @p i from its opposite face: what a change of the
     * barycentric coordinate i by one means. */
    double
    height(unsigned int i) const;
  };

  inline double
  smallest(const mesh::Barycentric &b)
  {
    return std::min(std::min(b[0], b[1]), std::min(b[2], b[3]));
  }

  /** A location in @p cell with negative coordinates cut off. */
  Location
  clamped(unsigned int cell, const mesh::Barycentric &b);
} // namespace tetradapt::compare::internal

#endif
