// SPDX-License-Identifier: AGPL-3.0-or-later

// Alone in a file because it takes half a minute to compile.

#include "cgal_surface.h"

#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>

namespace tetradapt::geometry
{
  bool
  remove_self_intersections(CgalSurface &surface)
  {
    return CGAL::Polygon_mesh_processing::experimental::remove_self_intersections(surface);
  }
} // namespace tetradapt::geometry
