// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/geometry/triangle_conflicts.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tetradapt::geometry
{
  namespace
  {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Box    = CGAL::Box_intersection_d::Box_d<double, 3>;
    using dealii::Tensor;
    using Kind = TriangleConflict::Kind;

    /** What lies on each other, relative to the triangles' size. */
    constexpr double contact = 1e-6;

    /** Cosine between normals that look at each other: within 15 degrees. */
    constexpr double facing = -0.966;

    class PairTest
    {
    public:
      PairTest(const SurfaceMesh &boundary, const std::vector<unsigned int> &parts, double gap)
        : boundary(boundary), parts(parts), gap(gap)
      {
      }

      double
      longest_edge(const unsigned int t) const
      {
        double longest = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          longest = std::max(longest, corner(t, i).distance(corner(t, (i + 1) % 3)));
        return longest;
      }

      /** The conflict of two triangles, if they have one. */
      std::optional<TriangleConflict>
      conflict(unsigned int a, unsigned int b) const
      {
        if (a > b)
          std::swap(a, b);
        const double size   = std::min(longest_edge(a), longest_edge(b));
        const auto   shared = shared_corners(a, b);
        if (meet(a, b, shared))
          return TriangleConflict{penetrate(a, b, contact * size) ? Kind::crossing
                                                                  : Kind::interface,
                                  a,
                                  b,
                                  nearest(a, b).first,
                                  0.};
        if (!shared.empty() || parts[a] == parts[b] || !looks_at(a, b))
          return std::nullopt;
        const auto [place, distance] = nearest(a, b);
        if (distance >= gap * size)
          return std::nullopt;
        return TriangleConflict{
          distance < contact * size ? Kind::interface : Kind::gap, a, b, place, distance};
      }

    private:
      const Point<3> &
      corner(const unsigned int t, const unsigned int i) const
      {
        return boundary.points[boundary.triangles[t][i]];
      }

      Kernel::Point_3
      exact(const unsigned int t, const unsigned int i) const
      {
        const Point<3> &p = corner(t, i);
        return {p[0], p[1], p[2]};
      }

      Tensor<1, 3>
      normal(const unsigned int t) const
      {
        const Tensor<1, 3> n
          = dealii::cross_product_3d(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
        return n / n.norm();
      }

      bool
      looks_at(const unsigned int a, const unsigned int b) const
      {
        return normal(a) * normal(b) < facing;
      }

      /** Pairs of places of the corners that two triangles share. */
      std::vector<std::pair<unsigned int, unsigned int>>
      shared_corners(const unsigned int a, const unsigned int b) const
      {
        std::vector<std::pair<unsigned int, unsigned int>> shared;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            if (boundary.triangles[a][i] == boundary.triangles[b][j])
              shared.emplace_back(i, j);
        return shared;
      }

      Kernel::Triangle_3
      exact(const unsigned int t) const
      {
        return {exact(t, 0), exact(t, 1), exact(t, 2)};
      }

      Kernel::Segment_3
      opposite(const unsigned int t, const unsigned int i) const
      {
        return {exact(t, (i + 1) % 3), exact(t, (i + 2) % 3)};
      }

      /** Whether two triangles have points in common beyond their common corner or edge. */
      bool
      meet(const unsigned int                                        a,
           const unsigned int                                        b,
           const std::vector<std::pair<unsigned int, unsigned int>> &shared) const
      {
        if (shared.empty())
          return CGAL::do_intersect(exact(a), exact(b));
        if (shared.size() == 1)
          return CGAL::do_intersect(opposite(a, shared[0].first), exact(b))
                 || CGAL::do_intersect(opposite(b, shared[0].second), exact(a));
        if (shared.size() > 2)
          return true;
        // With a common edge they overlap if they lie in one plane on one side of it.
        const auto p = exact(a, shared[0].first), q = exact(a, shared[1].first);
        const auto r = exact(a, 3 - shared[0].first - shared[1].first);
        const auto s = exact(b, 3 - shared[0].second - shared[1].second);
        return CGAL::coplanar(p, q, r, s)
               && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
      }

      /** Whether the plane of @p b has corners of @p a on both sides, farther than @p
       * tolerance. */
      bool
      is_cut_by_plane(const unsigned int a, const unsigned int b, const double tolerance) const
      {
        double             lowest = 0., highest = 0.;
        const Tensor<1, 3> n = normal(b);
        for (unsigned int i = 0; i < 3; ++i)
          {
            const double height = n * (corner(a, i) - corner(b, 0));
            lowest              = std::min(lowest, height);
            highest             = std::max(highest, height);
          }
        return lowest < -tolerance && highest > tolerance;
      }

      bool
      lies_in_plane(const unsigned int a, const unsigned int b, const double tolerance) const
      {
        const Tensor<1, 3> n = normal(b);
        for (unsigned int i = 0; i < 3; ++i)
          if (std::abs(n * (corner(a, i) - corner(b, 0))) > tolerance)
            return false;
        return true;
      }

      /** Whether two triangles that meet do more than touch: they pass through each other,
       * or lie in one plane, look the same way and share some of its area. */
      bool
      penetrate(const unsigned int a, const unsigned int b, const double tolerance) const
      {
        if (is_cut_by_plane(a, b, tolerance) && is_cut_by_plane(b, a, tolerance))
          return true;
        return lies_in_plane(a, b, tolerance) && normal(a) * normal(b) > 0.
               && CGAL::do_intersect(seen_flat(a, b, 0.999), seen_flat(b, b, 1.));
      }

      /** Triangle @p t seen along the largest component of the normal of @p other, its
       * corners moved towards its centre by 1 - @p factor. In two dimensions, since with
       * rounding two triangles of one plane may miss each other in space. */
      Kernel::Triangle_2
      seen_flat(const unsigned int t, const unsigned int other, const double factor) const
      {
        const Tensor<1, 3> n       = normal(other);
        unsigned int       largest = 0;
        for (unsigned int d = 1; d < 3; ++d)
          if (std::abs(n[d]) > std::abs(n[largest]))
            largest = d;
        std::array<Kernel::Point_2, 3> p;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const Point<3> x = centre(t) + factor * (corner(t, i) - centre(t));
            p[i]             = {x[(largest + 1) % 3], x[(largest + 2) % 3]};
          }
        return {p[0], p[1], p[2]};
      }

      Point<3>
      centre(const unsigned int t) const
      {
        return Point<3>(
          (Tensor<1, 3>(corner(t, 0)) + Tensor<1, 3>(corner(t, 1)) + Tensor<1, 3>(corner(t, 2)))
          / 3.);
      }

      /** The point of a's corners and centre, or of b's moved onto a's plane, that is
       * nearest to the other triangle, and its distance. */
      std::pair<Point<3>, double>
      nearest(const unsigned int a, const unsigned int b) const
      {
        std::pair<Point<3>, double> best{corner(a, 0), 1e300};
        const auto                  look = [&](const unsigned int from, const unsigned int to) {
          const Kernel::Triangle_3 triangle = exact(to);
          for (unsigned int i = 0; i < 4; ++i)
            {
              const Point<3> p = i < 3 ? corner(from, i) : centre(from);
              const double   d
                = std::sqrt(CGAL::squared_distance(Kernel::Point_3(p[0], p[1], p[2]), triangle));
              if (d < best.second)
                best = {p, d};
            }
        };
        look(a, b);
        look(b, a);
        return best;
      }

      const SurfaceMesh               &boundary;
      const std::vector<unsigned int> &parts;
      double                           gap;
    };
  } // namespace

  std::vector<TriangleConflict>
  triangle_conflicts(const SurfaceMesh               &boundary,
                     const std::vector<unsigned int> &parts,
                     const double                     gap)
  {
    const PairTest   test(boundary, parts, gap);
    std::vector<Box> boxes;
    boxes.reserve(boundary.triangles.size());
    for (unsigned int t = 0; t < boundary.triangles.size(); ++t)
      {
        const double margin = 0.5 * std::max(gap, contact) * test.longest_edge(t);
        double       lower[3], upper[3];
        for (unsigned int d = 0; d < 3; ++d)
          {
            const auto &v    = boundary.triangles[t];
            const auto  ends = std::minmax(
              {boundary.points[v[0]][d], boundary.points[v[1]][d], boundary.points[v[2]][d]});
            lower[d] = ends.first - margin;
            upper[d] = ends.second + margin;
          }
        boxes.emplace_back(lower, upper);
      }
    std::vector<TriangleConflict> conflicts;
    const std::size_t             first = boxes.empty() ? 0 : boxes.front().id();
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box &a, const Box &b) {
      if (const auto conflict = test.conflict(a.id() - first, b.id() - first))
        conflicts.push_back(*conflict);
    });
    if (conflicts.empty())
      return conflicts;
    const auto by_kind = [](const auto &a, const auto &b) { return a.kind < b.kind; };
    const Kind worst   = std::min_element(conflicts.begin(), conflicts.end(), by_kind)->kind;
    conflicts.erase(std::remove_if(conflicts.begin(),
                                   conflicts.end(),
                                   [&](const auto &c) { return c.kind != worst; }),
                    conflicts.end());
    std::sort(conflicts.begin(), conflicts.end(), [](const auto &a, const auto &b) {
      return std::pair(a.first, a.second) < std::pair(b.first, b.second);
    });
    return conflicts;
  }
} // namespace tetradapt::geometry
