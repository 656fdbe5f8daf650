// SPDX-License-Identifier: AGPL-3.0-or-later
// Borders of conditions are cut into surfaces: the areas are right, the surface stays closed
// and in place, and nothing changes where no border runs.

#include "tetradapt/geometry/surface_cutting.h"

#include "surfaces.h"

#include "tetradapt/geometry/checked_surface.h"

#include <cmath>
#include <iostream>

using namespace tetradapt;
using namespace tetradapt::geometry;

double
area(const SurfaceMesh &surface, const std::array<unsigned int, 3> &t)
{
  const auto &p = surface.points;
  return .5 * dealii::cross_product_3d(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).norm();
}

/** Cuts and compares the area where the condition holds on triangles of one id, or all, with
 * what it should be. */
void
cut(const SurfaceMesh &surface,
    const std::string &where,
    const int          id,
    const double       expected,
    const double       tolerance)
{
  const core::Condition condition(where, "Where");
  const auto            result
    = cut_surface(surface,
                  {{"load", condition, [&](const int its) { return id == 0 || its == id; }}},
                  [](const Point<3> &) { return .3; });
  double       inside = 0.;
  unsigned int kept   = 0;
  for (std::size_t t = 0; t < result.origin.size(); ++t)
    {
      const auto &v = result.mesh.triangles[t];
      const auto &p = result.mesh.points;
      if ((id == 0 || result.mesh.ids[t] == id)
          && condition.holds(p[v[0]] + ((p[v[1]] - p[v[0]]) + (p[v[2]] - p[v[0]])) / 3.))
        inside += area(result.mesh, v);
      kept += result.origin[t] != CutSurface::nothing ? 1 : 0;
    }
  // Throws if it is not closed, or crosses itself.
  const auto checked = check_surface(result.mesh, "the cut surface");
  const auto before  = check_surface(surface, "the surface");
  const bool right   = std::abs(inside - expected) <= tolerance * expected;
  std::cout << where << ": "
            << (right ? "right"
                      : "WRONG " + std::to_string(inside) + ", not " + std::to_string(expected))
            << ", new points " << result.mesh.points.size() - surface.points.size() << ", kept "
            << kept << " of " << surface.triangles.size() << ", same body "
            << (std::abs(checked.volume - before.volume) <= 1e-12 * before.volume
                && std::abs(checked.area - before.area) <= 1e-12 * before.area);
  if (!result.short_edges.empty())
    std::cout << ", short edges of " << result.short_edges.front().name;
  std::cout << std::endl;
}

int
main()
{
  const double pi  = std::acos(-1.);
  const auto   one = surfaces::unit_cube();
  // Straight borders: exact.
  cut(one, "x < 0.3", 6, .3, 1e-12);
  cut(one, "x < 0.3", 0, 2.2, 1e-12);
  cut(one, "abs(x - .5) < .2 && abs(y - .4) < .1", 6, .08, 1e-12);
  cut(one, "x < .5 && y < .5 || x + y > 1.75", 6, .25 + .03125, 1e-12);
  cut(one, "!(x < .5 && y < .25)", 6, .875, 1e-12);
  cut(one, "box(.25,.25,.5, 2,.75,1.5)", 0, .625, 1e-12);
  cut(one, "x + y < 1", 6, .5, 1e-12); // along the diagonal
  cut(one, "x + y < .7 + z", 0, 3.6, 1e-12);
  // No border.
  cut(one, "x < 1e-9", 0, 1., 1e-12);
  cut(one, "z > 1 - 1e-9", 0, 1., 1e-12);
  cut(one, "half_space(0,0,1, 0,0,-1)", 0, 1., 1e-12);
  // Curved borders: closed, open, meeting straight ones, small ones.
  cut(one, "sphere(.5,.5,1, .25)", 6, pi / 16., 2e-3);
  cut(one, "(x - .5)^2 + (y - .5)^2 < .0625", 6, pi / 16., 2e-3);
  cut(one, "(x - .5)^2 + (y - .5)^2 < .0625 && x < .5", 6, pi / 32., 2e-3);
  cut(one, "sphere(.5,.25,1, .25)", 6, pi / 16., 5e-3); // touches an edge
  cut(one, "sphere(.5,.5,1, .5)", 6, pi / 4., 5e-3);    // and four
  cut(one, "sphere(0,0,0, .5)", 0, 3. * pi / 16., 2e-3);
  cut(one, "cylinder(.5,.5,-1, .5,.5,.5, .3)", 0, .09 * pi, 2e-3);
  cut(one, "cylinder(-1,.5,1, 2,.5,1, .25)", 6, .5, 1e-5);
  cut(one, "sphere(.31,.42,1, .004)", 6, pi * 1.6e-5, 2e-3);
  cut(one, "(x - .5)^2 + (y - .5)^2 < .0625 && !sphere(.5,.5,1, .125)", 6, 3. * pi / 64., 3e-3);
  cut(one, "y < .5 + .1*sin(2*pi*x)", 6, .5, 2e-3);
  // Narrow, and just beside an edge or a corner.
  cut(one, "x < .001", 6, .001, 1e-9);
  cut(one, "x < 1e-7", 6, 1e-7, 1.);
  cut(one, "x < .5 && y < .5 + 1e-8", 6, .25, 1e-6);
}
