// SPDX-License-Identifier: AGPL-3.0-or-later

// Good surfaces have their volume and area and end up outward; each kind of bad
// surface is refused with a message that says where it is bad.

#include "tetradapt/geometry/checked_surface.h"
#include "tetradapt/core/exceptions.h"

#include "surfaces.h"

#include <iostream>
#include <limits>

using namespace tetradapt;
using dealii::Point;
using geometry::SurfaceMesh;

namespace
{
  void
  accept(const std::string &name, const SurfaceMesh &surface)
  {
    const auto result = geometry::check_surface(surface, name);
    double     volume = 0.;
    for (const auto &t : result.mesh.triangles)
      {
        const auto &p = result.mesh.points;
        volume += Point<3>(p[t[0]]) * dealii::cross_product_3d(p[t[1]], p[t[2]]) / 6.;
      }
    std::cout << name << ": volume " << result.volume << ", signed " << volume << ", area "
              << result.area << ", parts " << result.n_components << ", dropped points "
              << result.dropped_points << ", turned triangles " << result.turned_triangles
              << std::endl;
  }

  void
  refuse(const std::string &name, const SurfaceMesh &surface)
  {
    try
      {
        geometry::check_surface(surface, name);
        std::cout << name << ": WRONGLY ACCEPTED" << std::endl;
      }
    catch (const core::InputError &error)
      {
        std::cout << error.what() << std::endl;
      }
  }

  void
  accept_good()
  {
    SurfaceMesh cube = surfaces::unit_cube();
    accept("cube", cube);

    SurfaceMesh inward = cube;
    for (auto &t : inward.triangles)
      std::swap(t[0], t[1]);
    accept("inward", inward);

    SurfaceMesh mixed = cube;
    std::swap(mixed.triangles[3][0], mixed.triangles[3][1]);
    std::swap(mixed.triangles[8][0], mixed.triangles[8][1]);
    mixed.points.insert(mixed.points.begin(), Point<3>(5, 5, 5));
    for (auto &t : mixed.triangles)
      for (unsigned int &v : t)
        ++v;
    accept("mixed", mixed);

    accept("two boxes", surfaces::join(cube, surfaces::box(Point<3>(2, 0, 0), Point<3>(4, 1, 1))));
  }

  void
  refuse_bad_lists()
  {
    const SurfaceMesh cube = surfaces::unit_cube();
    refuse("nothing", SurfaceMesh());
    SurfaceMesh s     = cube;
    s.triangles[4][1] = 8;
    refuse("number", s);
    s              = cube;
    s.points[3][1] = std::numeric_limits<double>::quiet_NaN();
    refuse("not a number", s);
    s              = cube;
    s.points[3][1] = std::numeric_limits<double>::infinity();
    refuse("infinite", s);
    s = cube;
    s.triangles.push_back({{0, 1, 1}});
    s.ids.push_back(1);
    refuse("degenerate", s);
    s = cube;
    s.points.push_back(s.points[7]);
    for (unsigned int &v : s.triangles[10])
      if (v == 7)
        v = 8;
    for (unsigned int &v : s.triangles[11])
      if (v == 7)
        v = 8;
    refuse("point twice", s);
    s = cube;
    s.triangles.push_back({{s.triangles[5][1], s.triangles[5][0], s.triangles[5][2]}});
    s.ids.push_back(1);
    refuse("triangle twice", s);
  }

  void
  refuse_bad_shapes()
  {
    const SurfaceMesh cube = surfaces::unit_cube();
    SurfaceMesh       s    = cube;
    s.triangles.pop_back();
    s.ids.pop_back();
    refuse("open", s);

    s = cube;
    s.points.emplace_back(0.5, 0.5, 2);
    s.triangles.push_back({{4, 5, 8}});
    s.ids.push_back(1);
    refuse("fin", s);

    // Two cubes that share the point (1, 1, 1).
    s = surfaces::join(cube, surfaces::box(Point<3>(1, 1, 1), Point<3>(2, 2, 2)));
    s.points.erase(s.points.begin() + 8);
    for (auto &t : s.triangles)
      for (unsigned int &v : t)
        v = v == 8 ? 7 : v > 8 ? v - 1 : v;
    refuse("touching in a point", s);

    refuse("crossing",
           surfaces::join(cube, surfaces::box(Point<3>(.6, .3, .2), Point<3>(1.6, .8, .7))));
    refuse("cavity",
           surfaces::join(cube, surfaces::box(Point<3>(.3, .3, .3), Point<3>(.6, .6, .6))));
    refuse("flat", surfaces::box(Point<3>(0, 0, 0), Point<3>(1, 1, 1e-4)));
    refuse("touching sides",
           surfaces::join(cube, surfaces::box(Point<3>(1, .25, .25), Point<3>(2, .75, .75))));

    // A torus of 4 x 4 quadrangles with one gluing reversed: a Klein bottle, which
    // has no inside (and crosses itself, but that is found later).
    s = SurfaceMesh();
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
        s.points.emplace_back(i + 0.1 * j * j, j + 0.05 * i * i, 0.3 * i * j + 0.7 * i);
    const auto point
      = [](unsigned int i, unsigned int j) { return i < 4 ? 4 * i + j % 4 : (4 - j % 4) % 4; };
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
        {
          s.triangles.push_back({{point(i, j), point(i + 1, j), point(i + 1, j + 1)}});
          s.triangles.push_back({{point(i, j), point(i + 1, j + 1), point(i, j + 1)}});
        }
    refuse("Klein bottle", s);
  }
} // namespace

int
main()
{
  accept_good();
  refuse_bad_lists();
  refuse_bad_shapes();
}
