// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_geometry_place_search_h
#define tetradapt_source_geometry_place_search_h

#include "border_curves.h"

#include "tetradapt/geometry/surface_cutting.h"

namespace tetradapt::geometry
{
  /**
   * Where a point or a straight line touches a flat part: points, and pieces of the line that lie
   * in the part, of two points each. Points are within @p snap of the part, and in its plane.
   * What runs along the part's outline is no piece; its ends are points.
   */
  std::vector<std::vector<Point<3>>>
  place_in_part(const PartOfSurface &part, const SurfacePlace &place, double snap);
} // namespace tetradapt::geometry

#endif
