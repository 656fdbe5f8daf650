// SPDX-License-Identifier: AGPL-3.0-or-later
// Flat parts of surfaces keep their corners only; nearest points lie on the surface, and on
// its sharp edges.

#include "tetradapt/geometry/flat_parts.h"
#include "tetradapt/geometry/checked_surface.h"
#include "tetradapt/geometry/nearest_surface.h"

#include <cmath>
#include <iostream>
#include <map>

using namespace tetradapt::geometry;

namespace
{
  /** An L of three unit cubes, 2 x 2 x 1, its squares cut into n x n pieces of two
   * triangles, turned in space; ids 0, but 1 on the top of the cube at the corner. */
  SurfaceMesh
  fine_l(unsigned int n)
  {
    const auto inside = [](int i, int j, int k) {
      return i >= 0 && j >= 0 && k == 0 && i < 2 && j < 2 && !(i == 1 && j == 1);
    };
    SurfaceMesh                                         surface;
    std::map<std::array<unsigned int, 3>, unsigned int> number;
    const auto                                          point = [&](std::array<unsigned int, 3> p) {
      const auto added = number.emplace(p, surface.points.size());
      if (added.second)
        {
          const double x = 1. * p[0] / n, y = 1. * p[1] / n, z = 1. * p[2] / n;
          surface.points.emplace_back(0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y, z);
        }
      return added.first->second;
    };
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        for (unsigned int d = 0; d < 3; ++d)
          for (int side = 0; side < 2; ++side)
            {
              std::array<int, 3> cube{{i, j, 0}}, other = cube;
              other[d] += side == 0 ? -1 : 1;
              if (!inside(i, j, 0) || inside(other[0], other[1], other[2]))
                continue;
              for (unsigned int a = 0; a < n; ++a)
                for (unsigned int b = 0; b < n; ++b)
                  {
                    const auto corner = [&](unsigned int da, unsigned int db) {
                      std::array<unsigned int, 3> p{{i * n, j * n, 0}};
                      p[d] += side * n;
                      p[(d + 1) % 3] += a + da;
                      p[(d + 2) % 3] += b + db;
                      return point(p);
                    };
                    const auto add = [&](unsigned int u, unsigned int v, unsigned int w) {
                      surface.triangles.push_back(side == 1
                                                    ? std::array<unsigned int, 3>{{u, v, w}}
                                                    : std::array<unsigned int, 3>{{u, w, v}});
                      surface.ids.push_back(d == 2 && side == 1 && i == 0 && j == 0 ? 1 : 0);
                    };
                    add(corner(0, 0), corner(1, 0), corner(1, 1));
                    add(corner(0, 0), corner(1, 1), corner(0, 1));
                  }
            }
    return surface;
  }

  SurfaceMesh
  without_unused(const SurfaceMesh &surface)
  {
    return check_surface(surface, "the L").mesh;
  }
} // namespace

int
main()
{
  const SurfaceMesh                 fine   = fine_l(6);
  const auto                        before = check_surface(fine, "the L");
  const FlatParts                   parts(fine);
  std::map<PointKind, unsigned int> count;
  for (const PointKind kind : parts.point_kinds())
    ++count[kind];
  std::cout << "corners " << count[PointKind::corner] << ", on lines " << count[PointKind::line]
            << ", in flat parts " << count[PointKind::flat] << '\n';
  const auto coarse
    = check_surface(parts.triangulate(std::vector<bool>(fine.points.size(), false)), "the L");
  unsigned int with_id = 0;
  for (const int id : coarse.mesh.ids)
    with_id += id == 1;
  std::cout << fine.triangles.size() << " triangles become " << coarse.mesh.triangles.size()
            << " with " << coarse.mesh.points.size() << " points, " << with_id
            << " of the square with id 1; volume " << coarse.volume << ", area " << coarse.area
            << ", turned " << coarse.turned_triangles << '\n';
  const auto all
    = check_surface(parts.triangulate(std::vector<bool>(fine.points.size(), true)), "the L");
  std::cout << "all points kept: " << all.mesh.points.size() - before.mesh.points.size()
            << " points and " << all.mesh.triangles.size() - before.mesh.triangles.size()
            << " triangles more, volume " << all.volume << '\n';

  // In the coordinates of the L: (1.5, 0.5, 3) lies above the square x > 1; (2.1, 1.2, 1.2)
  // beside the edge x = 2, z = 1, which ends at y = 1.
  const auto turned = [](double x, double y, double z) {
    return Point<3>(0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y, z);
  };
  const NearestSurface nearest(without_unused(fine), 60.);
  const auto           top = nearest.nearest(turned(1.5, 0.5, 3.));
  std::cout << "foot off by " << top.point.distance(turned(1.5, 0.5, 1.))
            << ", its normal has z = " << top.normal[2] << "; crease off by "
            << nearest.nearest_on_crease(turned(2.1, 1.2, 1.2))->distance(turned(2., 1., 1.))
            << ", its edge by "
            << nearest.nearest_on_crease(turned(1.9, 0.4, 0.95))->distance(turned(2., 0.4, 1.))
            << "; creases above 100 degrees "
            << (NearestSurface(without_unused(fine), 100.).nearest_on_crease(Point<3>()) ? "some"
                                                                                         : "none")
            << '\n';
}
