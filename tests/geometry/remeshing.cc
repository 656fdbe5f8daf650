// SPDX-License-Identifier: AGPL-3.0-or-later

// A box keeps its shape and ids exactly, a sphere nearly; edges get the wanted
// length; what cannot be remeshed is refused.

#include "tetradapt/geometry/remeshing.h"
#include "tetradapt/core/exceptions.h"

#include "surfaces.h"

#include <iostream>
#include <map>

using namespace tetradapt;
using dealii::Point;
using geometry::SurfaceMesh;

namespace
{
  double
  mean_edge(const SurfaceMesh &surface)
  {
    double sum = 0.;
    for (const auto &t : surface.triangles)
      for (unsigned int i = 0; i < 3; ++i)
        sum += surface.points[t[i]].distance(surface.points[t[(i + 1) % 3]]);
    return sum / (3. * surface.triangles.size());
  }

  std::map<int, double>
  areas(const SurfaceMesh &surface)
  {
    std::map<int, double> result;
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
      {
        const auto &t = surface.triangles[i];
        const auto &p = surface.points;
        result[surface.ids[i]]
          += dealii::cross_product_3d(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).norm() / 2.;
      }
    return result;
  }

  /** A sphere of radius 1 of @p n by @p n rectangles a side of a cube. */
  SurfaceMesh
  sphere(unsigned int n)
  {
    SurfaceMesh                                         surface;
    std::map<std::array<unsigned int, 3>, unsigned int> number;
    const auto point = [&](const std::array<unsigned int, 3> &i) {
      const auto found = number.insert({i, surface.points.size()});
      if (found.second)
        {
          Point<3> p;
          for (unsigned int d = 0; d < 3; ++d)
            p[d] = std::tan((2. * i[d] / n - 1.) * std::atan(1.));
          surface.points.emplace_back(p / p.norm());
        }
      return found.first->second;
    };
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int side = 0; side <= n; side += n)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            {
              const auto corner = [&](unsigned int a, unsigned int b) {
                std::array<unsigned int, 3> index{};
                index[d]           = side;
                index[(d + 1) % 3] = i + a;
                index[(d + 2) % 3] = j + b;
                return point(index);
              };
              surface.triangles.push_back({{corner(0, 0), corner(1, 0), corner(1, 1)}});
              surface.triangles.push_back({{corner(0, 0), corner(1, 1), corner(0, 1)}});
            }
    return surface;
  }

  void
  refuse(const SurfaceMesh &surface, double edge_length, double angle, const std::string &what)
  {
    try
      {
        geometry::remesh(surface, edge_length, angle, what);
        std::cout << what << ": WRONGLY ACCEPTED" << std::endl;
      }
    catch (const core::InputError &error)
      {
        // What becomes of the volume depends on CGAL's version.
        const std::string message = error.what();
        std::cout << message.substr(0, message.find(" changes its volume")) << std::endl;
      }
  }

  std::string
  within(double value, double lower, double upper)
  {
    return value >= lower && value <= upper ? "yes" : "no: " + std::to_string(value);
  }
} // namespace

int
main()
{
  const SurfaceMesh box     = surfaces::box(Point<3>(0, 0, 0), Point<3>(3, 1, 2));
  const auto        refined = geometry::remesh(box, 0.25, 60, "box");
  std::cout << "box: volume " << refined.surface.volume << ", area " << refined.surface.area
            << ", features kept " << refined.kept_features << ", mean edge within .22 to .28 "
            << within(mean_edge(refined.surface.mesh), .22, .28) << std::endl;
  const auto twice = geometry::remesh(box, 0.25, 60, "box");
  std::cout << "  same surface twice "
            << (twice.surface.mesh.points == refined.surface.mesh.points
                && twice.surface.mesh.triangles == refined.surface.mesh.triangles)
            << std::endl;
  for (const auto &[id, area] : areas(refined.surface.mesh))
    std::cout << "  area of id " << id << ": " << area << std::endl;
  const auto coarser = geometry::remesh(refined.surface.mesh, 0.5, 60, "box again");
  std::cout << "coarsened: volume " << coarser.surface.volume << ", mean edge within .42 to .58 "
            << within(mean_edge(coarser.surface.mesh), .42, .58) << std::endl;

  const double pi     = std::acos(-1.);
  const auto   coarse = geometry::remesh(sphere(24), 0.2, 60, "sphere");
  std::cout << "sphere: triangles are fewer "
            << (coarse.surface.mesh.triangles.size() < sphere(24).triangles.size())
            << ", volume by exact volume within .97 to 1 "
            << within(coarse.surface.volume / (4. / 3. * pi), .97, 1.)
            << ", mean edge within .17 to .23 " << within(mean_edge(coarse.surface.mesh), .17, .23)
            << std::endl;

  refuse(box, 0., 60, "zero edges");
  refuse(box, -1., 60, "negative edges");
  refuse(box, std::nan(""), 60, "edges that are not numbers");
  refuse(box, 0.1, 0., "no angle");
  refuse(box, 1e-4, 60., "the fine box");
  refuse(box, 20., 60., "the coarse box");
  refuse(sphere(24), 1., 60., "the coarse sphere");
}
