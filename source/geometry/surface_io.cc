// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/geometry/surface_io.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/surface_topology.h"

#include "surface_file.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace tetradapt::geometry
{
  namespace
  {
    using core::InputError;
    using CgalPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
    using Polygon   = std::vector<std::size_t>;

    /** A polygon soup as CGAL's readers fill it. */
    struct Soup
    {
      std::vector<CgalPoint> points;
      std::vector<Polygon>   polygons;
    };

    std::string
    ending(const std::string &file)
    {
      std::string text = std::filesystem::path(file).extension().string();
      std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
        return std::tolower(c);
      });
      return text;
    }

    void
    check_file(const std::string &file)
    {
      std::error_code error;
      const auto      status = std::filesystem::status(file, error);
      if (!std::filesystem::exists(status))
        throw InputError("The surface file '" + file + "' does not exist.");
      if (!std::filesystem::is_regular_file(status))
        throw InputError("The surface file '" + file + "' is not a file.");
      if (!std::ifstream(file).good())
        throw InputError("The surface file '" + file + "' cannot be read: check its permissions.");
      if (std::filesystem::file_size(file) == 0)
        throw InputError("The surface file '" + file + "' is empty.");
    }

    Soup
    read_soup(const std::string &file, const std::string &format)
    {
      Soup soup;
      bool good = false;
      try
        {
          if (format == ".stl")
            good = CGAL::IO::read_STL(file, soup.points, soup.polygons);
          else if (format == ".off")
            good = CGAL::IO::read_OFF(file, soup.points, soup.polygons);
          else if (format == ".obj")
            good = CGAL::IO::read_OBJ(file, soup.points, soup.polygons);
          else
            {
              std::istringstream contents(checked_ply(file));
              good = CGAL::IO::read_PLY(contents, soup.points, soup.polygons);
            }
        }
      catch (const InputError &)
        {
          throw;
        }
      catch (const std::exception &)
        {
          good = false;
        }
      if (!good)
        throw InputError(
          "The surface file '" + file + "' cannot be read as " + format.substr(1)
          + ": it is damaged, ends early, holds no triangles or has another format.");
      if (soup.polygons.empty())
        throw InputError("The surface file '" + file + "' holds no triangles.");
      return soup;
    }

    /** Twice the area vector of the triangle of three of the polygon's corners. */
    dealii::Tensor<1, 3>
    normal(const SurfaceMesh &surface, std::size_t a, std::size_t b, std::size_t c)
    {
      return dealii::cross_product_3d(surface.points[b] - surface.points[a],
                                      surface.points[c] - surface.points[a]);
    }

    /** Cuts a polygon into a fan of triangles that all look the same way; tries
     * each corner as the fan's centre. Returns false if there is none. */
    bool
    add_fan(SurfaceMesh &surface, const Polygon &polygon)
    {
      const std::size_t    n = polygon.size();
      dealii::Tensor<1, 3> mean;
      for (std::size_t i = 2; i < n; ++i)
        mean += normal(surface, polygon[0], polygon[i - 1], polygon[i]);
      for (std::size_t centre = 0; centre < n; ++centre)
        {
          const auto corner = [&](std::size_t i) { return polygon[(centre + i) % n]; };
          bool       good   = true;
          for (std::size_t i = 2; i < n; ++i)
            good = good && normal(surface, corner(0), corner(i - 1), corner(i)) * mean > 0.;
          if (!good)
            continue;
          for (std::size_t i = 2; i < n; ++i)
            surface.triangles.push_back({{static_cast<unsigned int>(corner(0)),
                                          static_cast<unsigned int>(corner(i - 1)),
                                          static_cast<unsigned int>(corner(i))}});
          return true;
        }
      return false;
    }

    void
    add_polygon(SurfaceMesh       &surface,
                const Polygon     &polygon,
                std::size_t        number,
                const std::string &file)
    {
      const std::string where = "The surface file '" + file + "': polygon " + std::to_string(number)
                                + " (counted from 0) ";
      if (polygon.size() < 3)
        throw InputError(where + "has " + std::to_string(polygon.size()) + " corners.");
      for (const std::size_t v : polygon)
        if (v >= surface.points.size())
          throw InputError(where + "names a point that does not exist; there are "
                           + std::to_string(surface.points.size()) + " points.");
      if (polygon.size() == 3)
        surface.triangles.push_back({{static_cast<unsigned int>(polygon[0]),
                                      static_cast<unsigned int>(polygon[1]),
                                      static_cast<unsigned int>(polygon[2])}});
      else if (!add_fan(surface, polygon))
        throw InputError(where + "with " + std::to_string(polygon.size())
                         + " corners, the first at " + to_string(surface.points[polygon[0]])
                         + ", is not convex. Cut it into triangles.");
    }
  } // namespace

  std::string
  surface_formats()
  {
    return ".obj, .off, .ply, .stl";
  }

  SurfaceMesh
  read_surface(const std::string &file)
  {
    const std::string format = ending(file);
    if (format.empty() || (surface_formats() + ',').find(format + ',') == std::string::npos)
      throw InputError("The surface file '" + file + "' has the unknown ending '" + format
                       + "'; known are " + surface_formats() + '.');
    check_file(file);
    if (format == ".off")
      check_off_file(file);
    const Soup soup = read_soup(file, format);
    if (soup.points.size() > std::numeric_limits<int>::max())
      throw InputError("The surface file '" + file + "' has too many points for this program.");

    SurfaceMesh surface;
    surface.points.reserve(soup.points.size());
    for (const CgalPoint &p : soup.points)
      surface.points.emplace_back(p.x(), p.y(), p.z());
    surface.triangles.reserve(soup.polygons.size());
    for (std::size_t i = 0; i < soup.polygons.size(); ++i)
      add_polygon(surface, soup.polygons[i], i, file);
    return surface;
  }
} // namespace tetradapt::geometry
