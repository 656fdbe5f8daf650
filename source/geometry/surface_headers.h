// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_geometry_surface_headers_h
#define tetradapt_geometry_surface_headers_h

#include <string>

namespace tetradapt::geometry
{
  /**
   * Checks the header of an .off or .ply file, so that CGAL's readers can be
   * given the file: they reserve memory for as many points and polygons as it
   * announces, and the one of .ply crashes on a header that is malformed.
   *
   * @throws InputError naming the file and the line.
   */
  void
  check_off_header(const std::string &file);

  /** As check_off_header(). */
  void
  check_ply_header(const std::string &file);
} // namespace tetradapt::geometry

#endif
