// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_geometry_surface_file_h
#define tetradapt_source_geometry_surface_file_h

#include <string>
#include <vector>

namespace tetradapt::geometry
{
  /**
   * Checks an .off file, header and every line, so that CGAL's reader can be given the
   * file: it reserves memory for as many points and polygons as are announced, and
   * crashes on lines that are too short.
   *
   * Read are OFF and its variants with colours, normals and texture coordinates (COFF,
   * NOFF, STOFF and their combinations), one point or polygon a line.
   *
   * @throws core::InputError naming the file and the line.
   */
  void
  check_off_file(const std::string &file);

  /**
   * Checks a .ply file, header and data, as check_off_file() does, and returns its
   * contents as CGAL's reader can take them: in text files whole-number types of
   * coordinates become double and those of point numbers int, since the reader crashes
   * on the first and ignores most of the second.
   *
   * @throws core::InputError naming the file and the line (of data in binary form: the
   *         element).
   */
  std::string
  checked_ply(const std::string &file);

  /** Throws a core::InputError: "The surface file 'x.off', line 3: problem". */
  [[noreturn]] void
  refuse_line(const std::string &file, unsigned int line, const std::string &problem);

  /** The number of points or polygons that @p word announces.
   * @throws core::InputError if it is none, or more than @p n_bytes can hold. */
  unsigned long
  announced_count(const std::string &file,
                  unsigned int       line,
                  const std::string &word,
                  unsigned long      n_bytes);

  /** The words of a line, separated by blanks and tabs. */
  std::vector<std::string>
  words_of(const std::string &line);

  /** The number that @p word is. @throws core::InputError if it is none. */
  double
  number_of(const std::string &file, unsigned int line, const std::string &word);

  /** The number of an existing point that @p word is, counted from 0.
   * @throws core::InputError if it is none. */
  unsigned long
  point_of(const std::string &file,
           unsigned int       line,
           const std::string &word,
           unsigned long      n_points);
} // namespace tetradapt::geometry

#endif
