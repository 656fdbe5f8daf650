// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_geometry_surface_io_h
#define tetradapt_geometry_surface_io_h

#include "tetradapt/geometry/surface_mesh.h"

#include <string>

namespace tetradapt::geometry
{
  /** The endings that read_surface() knows: ".obj, .off, .ply, .stl". */
  std::string
  surface_formats();

  /**
   * Reads a triangulated surface by CGAL's readers: .stl (text or binary), .off,
   * .obj or .ply, recognised by the file's ending in any case of letters. Points
   * of an .stl file with exactly the same coordinates become one; polygons with
   * more than three corners are cut into triangles. All boundary ids are 0. Nothing
   * else is checked or repaired: see check_surface().
   *
   * @throws InputError naming the file if it is missing, has an unknown ending,
   *         cannot be parsed, is empty, or has a polygon that is not convex.
   */
  SurfaceMesh
  read_surface(const std::string &file);
} // namespace tetradapt::geometry

#endif
