// SPDX-License-Identifier: AGPL-3.0-or-later

// Point location on shaken, graded (size ratio 1e5), flattened and far away
// meshes, and in one with a notch: inside cells, on faces, edges and vertices
// against all cells in extended precision; outside against exact distances.

#include "tetradapt/compare/point_locator.h"
#include "tetradapt/core/exceptions.h"

#include "test_meshes.h"

#include <cmath>
#include <iostream>

using namespace test_meshes;
using compare::Location;
using compare::PointLocator;

namespace
{
  /** Smallest signed distance of @p p to the planes of @p cell's faces: negative
   * outside. */
  long double
  depth(const mesh::TetMesh &mesh, const unsigned int cell, const Point<3> &p)
  {
    using Vector     = std::array<long double, 3>;
    const auto minus = [](const Point<3> &a, const Point<3> &b) {
      return Vector{
        {(long double)(a[0]) - b[0], (long double)(a[1]) - b[1], (long double)(a[2]) - b[2]}};
    };
    long double smallest = 1e30L;
    for (unsigned int i = 0; i < 4; ++i)
      {
        const auto     &v = mesh.cells[cell];
        const Point<3> &a = mesh.points[v[(i + 1) % 4]];
        const Vector    b = minus(mesh.points[v[(i + 2) % 4]], a);
        const Vector    c = minus(mesh.points[v[(i + 3) % 4]], a);
        const Vector    n{
          {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]}};
        const Vector top = minus(mesh.points[v[i]], a), x = minus(p, a);
        long double  side = 0., here = 0., norm = 0.;
        for (unsigned int d = 0; d < 3; ++d)
          {
            side += n[d] * top[d];
            here += n[d] * x[d];
            norm += n[d] * n[d];
          }
        smallest = std::min(smallest, (side > 0 ? here : -here) / std::sqrt(norm));
      }
    return smallest;
  }

  double
  size(const mesh::TetMesh &mesh)
  {
    const auto [low, high] = mesh::bounding_box(mesh);
    return (high - low).norm();
  }

  Point<3>
  position(const mesh::TetMesh &mesh, const Location &location)
  {
    // Relative to one vertex, so that far away meshes lose no digits here.
    const Point<3> &origin = mesh.points[mesh.cells[location.cell][0]];
    Tensor<1, 3>    shift;
    for (unsigned int i = 1; i < 4; ++i)
      shift += location.barycentric[i] * (mesh.points[mesh.cells[location.cell][i]] - origin);
    return origin + shift;
  }

  /** Random points: @p n_zero of the barycentric coordinates in a random cell
   * are zero (0: inside, 1: on a face, 2: on an edge, 3: a vertex). */
  std::vector<Point<3>>
  sample(const mesh::TetMesh &mesh, const unsigned int n, const unsigned int n_zero, Random &random)
  {
    std::vector<Point<3>> points;
    for (unsigned int k = 0; k < n; ++k)
      {
        Location location;
        location.cell           = static_cast<unsigned int>(random() * mesh.n_cells());
        const unsigned int turn = static_cast<unsigned int>(random() * 4);
        double             sum  = 0.;
        for (unsigned int i = n_zero; i < 4; ++i)
          sum += location.barycentric[(i + turn) % 4] = 0.01 + random();
        for (double &b : location.barycentric)
          b /= sum;
        points.push_back(n_zero == 3 ? mesh.points[mesh.cells[location.cell][(3 + turn) % 4]]
                                     : position(mesh, location));
      }
    return points;
  }

  void
  check_inside(const std::string &name, std::shared_ptr<const mesh::TetMesh> mesh)
  {
    const PointLocator locator(mesh);
    const double       length    = size(*mesh);
    const double       tolerance = 2e-12 * length + 1e-14 * mesh->points.back().norm();
    Random             random(7);
    for (unsigned int n_zero = 0; n_zero < 4; ++n_zero)
      {
        const auto   points = sample(*mesh, 2500, n_zero, random);
        const auto   found  = locator.locate(points);
        unsigned int wrong = 0, outside = 0, misplaced = 0, hint_matters = 0;
        for (unsigned int i = 0; i < points.size(); ++i)
          {
            // The cell is right if no other one holds the point by more.
            const long double own = depth(*mesh, found[i].cell, points[i]);
            if (own < -tolerance)
              ++wrong;
            outside += found[i].distance != 0.;
            misplaced += position(*mesh, found[i]).distance(points[i]) > 4. * tolerance;
            const unsigned int hint = static_cast<unsigned int>(random() * mesh->n_cells());
            hint_matters += locator.locate(points[i], hint).cell != found[i].cell;
            hint_matters += locator.locate(points[i]).cell != found[i].cell;
          }
        // Inside one cell, all others must be farther.
        unsigned int ambiguous = 0;
        if (n_zero == 0)
          for (unsigned int i = 0; i < 200; ++i)
            for (unsigned int cell = 0; cell < mesh->n_cells(); ++cell)
              ambiguous
                += cell != found[i].cell
                   && depth(*mesh, cell, points[i]) > depth(*mesh, found[i].cell, points[i]);
        const char *where[] = {"inside", "face", "edge", "vertex"};
        std::cout << name << ' ' << where[n_zero] << ": wrong cell " << wrong << ", called outside "
                  << outside << ", misplaced " << misplaced << ", depends on hint " << hint_matters
                  << ", better cell exists " << ambiguous << std::endl;
      }
  }

  /** Distance from p to the box low..high. */
  double
  box_distance(const Point<3> &p, const Point<3> &low, const Point<3> &high)
  {
    double square = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      square += std::pow(std::max({low[d] - p[d], 0., p[d] - high[d]}), 2);
    return std::sqrt(square);
  }

  /** Outside points, near and far: the distance is exact, the place is on the
   * boundary at that distance. @p exact gives the distance to the domain. */
  void
  check_outside(const std::string                             &name,
                std::shared_ptr<const mesh::TetMesh>           mesh,
                const std::function<double(const Point<3> &)> &exact)
  {
    const PointLocator locator(mesh);
    Random             random(11);
    for (const double reach : {3., 0.1, 1e-3, 1e-7})
      {
        std::vector<Point<3>> points;
        while (points.size() < 2000)
          {
            Point<3> p;
            for (unsigned int d = 0; d < 3; ++d)
              p[d] = -reach + (1. + 2. * reach) * random();
            if (reach < 1.)
              {
                const unsigned int d = static_cast<unsigned int>(3 * random());
                const double       s = reach * random();
                // To a face of the cube, or to a face of the notch.
                p[d] = random() < 0.5 ? -s : (random() < 0.5 ? 1. + s : 0.5 + s);
              }
            if (exact(p) > 0.)
              points.push_back(p);
          }
        const auto   found          = locator.locate(points);
        unsigned int wrong_distance = 0, wrong_place = 0, negative = 0;
        for (unsigned int i = 0; i < points.size(); ++i)
          {
            const double truth = exact(points[i]);
            wrong_distance += std::abs(found[i].distance - truth) > 4e-12 + 1e-10 * truth;
            wrong_place += std::abs(position(*mesh, found[i]).distance(points[i]) - truth)
                           > 4e-12 + 1e-10 * truth;
            for (const double b : found[i].barycentric)
              negative += !(b >= 0.);
          }
        std::cout << name << " outside by up to " << reach << ": wrong distance " << wrong_distance
                  << ", wrong place " << wrong_place << ", negative coordinates " << negative
                  << std::endl;
      }
  }
} // namespace

int
main()
{
  const unsigned int n = 8;
  check_inside("shaken", cube(n, shaken(n, 0.25, 1)));

  // Edges from 1 down to 1e-5 towards one corner, shaken before.
  const auto shake = shaken(n, 0.2, 2);
  const auto grade = [&](const Point<3> &p) {
    Point<3> q = shake(p);
    for (unsigned int d = 0; d < 3; ++d)
      q[d] = std::expm1(13.2 * q[d]) / std::expm1(13.2);
    return q;
  };
  check_inside("graded", cube(n, grade));

  const auto flatten = [&](const Point<3> &p) {
    const Point<3> q = shake(p);
    return Point<3>(q[0], q[1] + 0.5 * q[0], 1e-5 * q[2] + 0.2 * q[0]);
  };
  check_inside("slivers", cube(n, flatten));

  const auto far = [&](const Point<3> &p) { return shake(p) + Tensor<1, 3>({1e6, -2e6, 3e6}); };
  check_inside("far away", cube(n, far));

  const Point<3> zero(0., 0., 0.), one(1., 1., 1.);
  check_outside("shaken", cube(n, shaken(n, 0.25, 3)), [&](const Point<3> &p) {
    return box_distance(p, zero, one);
  });

  // The cube without its quarter x, y > 0.5: not convex, so walks end at the notch.
  auto notched = std::make_shared<mesh::TetMesh>(*cube(n, [](const Point<3> &p) { return p; }));
  for (unsigned int cell = 0; cell < notched->cells.size();)
    {
      Point<3> centre;
      for (const unsigned int v : notched->cells[cell])
        centre += 0.25 * (notched->points[v] - zero);
      if (centre[0] > 0.5 && centre[1] > 0.5)
        {
          notched->cells[cell] = notched->cells.back();
          notched->cells.pop_back();
          notched->regions.pop_back();
        }
      else
        ++cell;
    }
  check_inside("notched", notched);
  check_outside("notched", notched, [&](const Point<3> &p) {
    return std::min(box_distance(p, zero, Point<3>(1., .5, 1.)),
                    box_distance(p, zero, Point<3>(.5, 1., 1.)));
  });

  try
    {
      PointLocator(notched).locate(Point<3>(0., std::nan(""), 0.));
    }
  catch (const core::NumericalError &error)
    {
      std::cout << error.what() << std::endl;
    }
}
