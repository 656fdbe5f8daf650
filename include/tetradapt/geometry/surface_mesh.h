// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_geometry_surface_mesh_h
#define tetradapt_geometry_surface_mesh_h

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace tetradapt::geometry
{
  using dealii::Point;

  /** A triangulated surface as plain data. */
  struct SurfaceMesh
  {
    std::vector<Point<3>>                    points;
    std::vector<std::array<unsigned int, 3>> triangles;
    std::vector<int>                         ids; ///< boundary id a triangle; empty: all 0
  };
} // namespace tetradapt::geometry

#endif
