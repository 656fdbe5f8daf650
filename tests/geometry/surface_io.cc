// SPDX-License-Identifier: AGPL-3.0-or-later

// A unit cube in every format, polygons, and files that cannot be used.

#include "tetradapt/geometry/surface_io.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/checked_surface.h"

#include "surfaces.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace tetradapt;

namespace
{
  void
  read(const std::string &file)
  {
    try
      {
        const auto   surface = geometry::read_surface(file);
        const double volume  = geometry::check_surface(surface, file).volume;
        std::cout << file << ": " << surface.points.size() << " points, "
                  << surface.triangles.size() << " triangles, volume " << volume << std::endl;
      }
    catch (const core::InputError &error)
      {
        std::cout << error.what() << std::endl;
      }
  }

  void
  read(const std::string &file, const std::string &content)
  {
    std::ofstream(file, std::ios::binary) << content;
    read(file);
  }

  const geometry::SurfaceMesh cube = surfaces::unit_cube();

  std::string
  points(const std::string &prefix)
  {
    std::ostringstream text;
    for (const auto &p : cube.points)
      text << prefix << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    return text.str();
  }

  std::string
  triangles(const std::string &prefix, unsigned int shift, const std::string &end = "")
  {
    std::ostringstream text;
    for (const auto &t : cube.triangles)
      text << prefix << t[0] + shift << ' ' << t[1] + shift << ' ' << t[2] + shift << end << '\n';
    return text.str();
  }

  std::string
  text_stl()
  {
    std::ostringstream text;
    text << "solid cube\n";
    for (const auto &t : cube.triangles)
      {
        text << "facet normal 0 0 0\nouter loop\n";
        for (const unsigned int v : t)
          text << "vertex " << cube.points[v][0] << ' ' << cube.points[v][1] << ' '
               << cube.points[v][2] << '\n';
        text << "endloop\nendfacet\n";
      }
    return text.str() + "endsolid cube\n";
  }

  std::string
  coloured_points()
  {
    std::ostringstream text;
    for (const auto &p : cube.points)
      text << p[0] << ' ' << p[1] << ' ' << p[2] << " 0.5 0.25 1\n";
    return text.str();
  }

  template <typename T>
  void
  append(std::string &bytes, T value)
  {
    bytes.append(reinterpret_cast<const char *>(&value), sizeof(value));
  }

  std::string
  binary_stl()
  {
    std::string bytes(80, ' ');
    append(bytes, static_cast<std::uint32_t>(cube.triangles.size()));
    for (const auto &t : cube.triangles)
      {
        for (unsigned int i = 0; i < 3; ++i)
          append(bytes, 0.f);
        for (const unsigned int v : t)
          for (unsigned int d = 0; d < 3; ++d)
            append(bytes, static_cast<float>(cube.points[v][d]));
        append(bytes, static_cast<std::uint16_t>(0));
      }
    return bytes;
  }

  /** A .ply file in binary form, with @p shift added to the point numbers. */
  template <typename Coordinate, typename Number>
  std::string
  binary_ply(const std::string &coordinate, const std::string &number, const int shift = 0)
  {
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 8\n";
    for (const char *name : {"x", "y", "z"})
      bytes += "property " + coordinate + ' ' + name + '\n';
    bytes += "element face 12\nproperty list uchar " + number + " vertex_indices\nend_header\n";
    for (const auto &p : cube.points)
      for (unsigned int d = 0; d < 3; ++d)
        append(bytes, static_cast<Coordinate>(p[d]));
    for (const auto &t : cube.triangles)
      {
        append(bytes, static_cast<std::uint8_t>(3));
        for (const unsigned int v : t)
          append(bytes, static_cast<Number>(v + shift));
      }
    return bytes;
  }
} // namespace

int
main()
{
  const std::string off = "OFF\n8 12 0\n" + points("") + triangles("3 ", 0);
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty "
                          "float y\nproperty float z\nelement face 12\nproperty list uchar int "
                          "vertex_indices\nend_header\n";

  read("cube.off", off);
  read("CUBE.OFF", off);
  read("cube.obj", points("v ") + triangles("f ", 1));
  read("cube.ply", ply + points("") + triangles("3 ", 0));
  read("text.stl", text_stl());
  read("binary.stl", binary_stl());
  read("quadrangles.off",
       "OFF\n8 6 0\n" + points("")
         + "4 0 4 6 2\n4 1 3 7 5\n4 0 1 5 4\n4 2 6 7 3\n4 0 2 3 1\n4 4 5 7 6\n");

  // CGAL's reader crashes on coordinates of whole-number types, and takes point numbers of
  // four bytes only.
  const auto replaced = [](std::string text, const std::string &old, const std::string &by) {
    for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size())
      text.replace(at, old.size(), by);
    return text;
  };
  read("whole.ply", replaced(ply, "float", "short") + points("") + triangles("3 ", 0));
  read("small.ply", replaced(ply, "uchar int", "int ushort") + points("") + triangles("3 ", 0));
  read("little.ply", binary_ply<float, std::int32_t>("float", "int"));
  read("little_whole.ply", binary_ply<std::int32_t, std::int32_t>("int", "int"));
  read("little_short.ply", binary_ply<float, std::int16_t>("float", "short"));
  read("colours.off", "COFF\n8 12 0\n" + coloured_points() + triangles("3 ", 0));
  read("coloured_faces.off", "OFF\n8 12 0\n" + points("") + triangles("3 ", 0, " 255 0 0"));
  read("comments.off",
       "# a cube\nOFF # really\n\n8 12 0\n" + points("") + "# triangles\n" + triangles("3 ", 0));

  std::filesystem::create_directory("folder.stl");
  read("missing.off");
  read("folder.stl");
  read("cube.step", off);
  read("cube", off);
  read("empty.off", "");
  read("words.off", "this is not a surface\n");
  read("words.stl",
       "this is not a surface, but it is longer than the header of a binary file, "
       "which has eighty bytes\n");
  read("cut.off", off.substr(0, off.size() / 2));
  read("cut.stl", binary_stl().substr(0, 300));
  read("cut.ply", ply + points(""));
  read("huge.off", "OFF\n4000000000 12 0\n0 0 0\n");
  read("huge.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\n");
  // CGAL's reader crashes on properties without an element.
  read("no_element.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n");
  read("no_end.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
  read("no_faces.ply", "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n");
  read("no_triangles.obj", points("v "));
  read("out_of_range.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  read("two_corners.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n");
  // Each ended in a segmentation fault or an endless loop of CGAL's readers, or was read
  // as something else.
  read("short_line.off", "COFF\n3 0 0\nx\n");
  read("no_colour.off", "COFF\n8 12 0\n" + points("") + triangles("3 ", 0));
  read("binary.off", "OFF BINARY\n8 12 0\n" + points(""));
  read("other.off", "4OFF\n8 12 0\n" + points("") + triangles("3 ", 0));
  read("letter.off", replaced(off, "1 1 1", "1 x 1"));
  read("endless.off", replaced(off, "1 1 1", "1 nan 1"));
  read("many_corners.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1000000000 0 1 2\n");
  read("minus.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n");
  read("short_line.ply", ply + replaced(points(""), "1 1 1", "1 1") + triangles("3 ", 0));
  read("long_line.ply", ply + replaced(points(""), "1 1 1", "1 1 1 1") + triangles("3 ", 0));
  read("out_of_range.ply", ply + points("") + replaced(triangles("3 ", 0), "7", "8"));
  read("cut_little.ply", binary_ply<float, std::int32_t>("float", "int").substr(0, 300));
  read("range_little.ply", binary_ply<float, std::int32_t>("float", "int", 1));
  read("real_corners.ply", replaced(ply, "uchar int", "uchar float"));
  read("one_word.off", std::string(100000, '7'));
  // A letter U: no corner sees all others.
  read("not_convex.off",
       "OFF\n8 1 0\n0 0 0\n3 0 0\n3 2 0\n2 2 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n8 0 1 2 3 4 5 6 7\n");
}
