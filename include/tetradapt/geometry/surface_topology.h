// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_geometry_surface_topology_h
#define tetradapt_geometry_surface_topology_h

#include "tetradapt/geometry/surface_mesh.h"

#include <string>

namespace tetradapt::geometry
{
  /** "(x, y, z)" with as many digits as a message needs. */
  std::string
  to_string(const Point<3> &point);

  /**
   * Refuses what is wrong with a list of triangles before they are put together:
   * empty lists, numbers out of range, coordinates that are not finite or too
   * large to be squared, triangles without area, points and triangles that occur
   * twice. Points that no triangle names are removed from @p surface before the
   * others are compared; their number is returned.
   *
   * @param what names the surface at the beginning of messages.
   * @throws InputError naming the first offender and how many there are.
   */
  unsigned int
  check_triangles(SurfaceMesh &surface, const std::string &what);

  /** How the triangles of a closed surface hang together. */
  struct SurfaceTopology
  {
    std::vector<unsigned int> component; ///< one number a triangle, from 0
    unsigned int              n_components = 0;
    /** Whether a triangle had to be turned to agree with its neighbours. */
    std::vector<bool> turned;
  };

  /**
   * Checks that the surface is closed, manifold and has two sides, and turns
   * triangles of @p surface so that neighbours agree; the first of each
   * component keeps its orientation.
   *
   * @throws InputError naming the edge or the point where it is not.
   */
  SurfaceTopology
  orient_consistently(SurfaceMesh &surface, const std::string &what);
} // namespace tetradapt::geometry

#endif
