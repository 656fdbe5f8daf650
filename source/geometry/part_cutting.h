// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_geometry_part_cutting_h
#define tetradapt_source_geometry_part_cutting_h

#include "border_curves.h"
#include "point_merger.h"

#include <map>

namespace tetradapt::geometry
{
  /** The points that cuts make on an edge, whose smaller end is first; from there in
   * order. */
  using EdgeCuts = std::map<std::pair<unsigned int, unsigned int>, std::vector<unsigned int>>;

  /**
   * Triangulates a flat part between its outline, with the points on it, its own inner points
   * and polylines.
   *
   * @param lines numbers of points. Where they cross each other, points are added to
   *        @p points.
   * @throws core::NumericalError if rounding spoils it.
   */
  std::vector<std::array<unsigned int, 3>>
  triangulate_with_cuts(const PartOfSurface                          &part,
                        const EdgeCuts                               &cuts,
                        const std::vector<std::vector<unsigned int>> &lines,
                        double                                        snap,
                        PointMerger                                  &points);
} // namespace tetradapt::geometry

#endif
