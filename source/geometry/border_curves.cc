// SPDX-License-Identifier: AGPL-3.0-or-later
#include "border_curves.h"

#include "point_merger.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tetradapt::geometry
{
  namespace
  {
    using Leaf = core::ConditionLeaf;
    using Kind = core::ConditionLeaf::Kind;

    /** Parts of the body's extent. */
    constexpr double same_point    = 1e-6;
    constexpr double scan_distance = 1e-2;

    /** Whether |level| is at most the distance from the border. */
    bool
    is_distance(const Leaf &leaf)
    {
      return leaf.kind == Kind::affine || leaf.kind == Kind::sphere || leaf.kind == Kind::cylinder;
    }

    Point<3>
    between(const Point<3> &a, const Point<3> &b, const double t)
    {
      return a + t * (b - a);
    }

    double
    longest(const std::array<Point<3>, 3> &p)
    {
      return std::max({p[0].distance(p[1]), p[1].distance(p[2]), p[2].distance(p[0])});
    }

    std::vector<BorderCurve>
    straight_lines(const PartOfSurface       &part,
                   const Leaf                &leaf,
                   const std::vector<double> &levels,
                   const double               snap)
    {
      const auto           &points    = part.surface.points;
      const Tensor<1, 3>    direction = dealii::cross_product_3d(part.normal(), leaf.normal);
      std::vector<Point<3>> crossings;
      // The plane of the part itself crosses it nowhere.
      if (std::all_of(part.outline().begin(), part.outline().end(), [&](const auto &side) {
            return std::abs(levels[side.first]) <= snap && std::abs(levels[side.second]) <= snap;
          }))
        return {};
      for (const OutlineSide &side : part.outline())
        {
          const double a = levels[side.first], b = levels[side.second];
          if (std::abs(a) <= snap)
            crossings.push_back(points[side.first]);
          if (std::abs(b) <= snap)
            crossings.push_back(points[side.second]);
          if (std::abs(a) > snap && std::abs(b) > snap && (a < 0.) != (b < 0.))
            crossings.push_back(between(points[side.first], points[side.second], a / (a - b)));
        }
      std::sort(crossings.begin(), crossings.end(), [&](const Point<3> &a, const Point<3> &b) {
        return (a - b) * direction < 0.;
      });
      std::vector<BorderCurve> lines;
      for (std::size_t i = 1; i < crossings.size(); ++i)
        if (crossings[i - 1].distance(crossings[i]) > snap
            && part.contains(between(crossings[i - 1], crossings[i], .5), snap))
          lines.push_back({{crossings[i - 1], crossings[i]}, false});
      return lines;
    }

    /** Follows the sign of a leaf over a triangulation of a flat part. */
    class Marching
    {
    public:
      Marching(const Leaf &leaf, const CutScale &scale)
        : leaf(leaf), spacing(scale.spacing_for(leaf)), merger(scale.snap)
      {
      }

      void
      visit(const std::array<Point<3>, 3> &p, const std::array<double, 3> &level)
      {
        const double length = longest(p);
        if (is_distance(leaf))
          {
            const Point<3> middle = p[0] + ((p[1] - p[0]) + (p[2] - p[0])) / 3.;
            if (std::abs(leaf.level(middle)) > length)
              return;
          }
        if (length <= spacing)
          {
            add_segment(p, level);
            return;
          }
        std::array<Point<3>, 3> m;
        std::array<double, 3>   at{};
        for (unsigned int i = 0; i < 3; ++i)
          {
            for (unsigned int d = 0; d < 3; ++d)
              m[i][d] = .5 * (p[i][d] + p[(i + 1) % 3][d]);
            at[i] = leaf.level(m[i]);
          }
        for (unsigned int i = 0; i < 3; ++i)
          visit({{p[i], m[i], m[(i + 2) % 3]}}, {{level[i], at[i], at[(i + 2) % 3]}});
        visit(m, at);
      }

      std::vector<BorderCurve>
      curves() const
      {
        std::vector<std::vector<unsigned int>> next(merger.points().size());
        for (const auto &[a, b] : segments)
          {
            next[a].push_back(b);
            next[b].push_back(a);
          }
        std::vector<BorderCurve>                        result;
        std::set<std::pair<unsigned int, unsigned int>> done;
        const auto follow = [&](unsigned int a, unsigned int b) {
          if (!done.insert(std::minmax(a, b)).second)
            return;
          const unsigned int start = a;
          BorderCurve        curve;
          curve.points = {merger.points()[a], merger.points()[b]};
          while (b != start && next[b].size() == 2)
            {
              const unsigned int beyond = next[b][0] == a ? next[b][1] : next[b][0];
              a                         = b;
              b                         = beyond;
              done.insert(std::minmax(a, b));
              curve.points.push_back(merger.points()[b]);
            }
          curve.closed = b == start;
          result.push_back(curve);
        };
        // What has ends first; then only closed ones are left.
        for (const bool ends : {true, false})
          for (unsigned int a = 0; a < next.size(); ++a)
            if (!ends || next[a].size() != 2)
              for (const unsigned int b : next[a])
                follow(a, b);
        return result;
      }

    private:
      void
      add_segment(const std::array<Point<3>, 3> &p, const std::array<double, 3> &level)
      {
        std::vector<unsigned int> ends;
        for (unsigned int i = 0; i < 3; ++i)
          if ((level[i] < 0.) != (level[(i + 1) % 3] < 0.))
            ends.push_back(merger.number(root(p[i], p[(i + 1) % 3])));
        if (ends.size() == 2 && ends[0] != ends[1])
          segments.insert(std::minmax(ends[0], ends[1]));
      }

      /** The same whichever end is first. */
      Point<3>
      root(const Point<3> &a, const Point<3> &b) const
      {
        for (unsigned int d = 0; d < 3; ++d)
          if (a[d] != b[d])
            {
              const Point<3> &from = a[d] < b[d] ? a : b, &to = a[d] < b[d] ? b : a;
              return between(from, to, change_of([&](const double t) {
                               return leaf.level(between(from, to, t)) < 0.;
                             }));
            }
        return a;
      }

      const Leaf                                     &leaf;
      double                                          spacing;
      PointMerger                                     merger;
      std::set<std::pair<unsigned int, unsigned int>> segments;
    };

    /** Whether the border may pass through a triangle. */
    bool
    may_cross(const PartOfSurface       &part,
              const unsigned int         triangle,
              const Leaf                &leaf,
              const std::vector<double> &levels,
              const CutScale            &scale)
    {
      const auto &v = part.surface.triangles[triangle];
      const bool  all
        = (levels[v[0]] < 0.) == (levels[v[1]] < 0.) && (levels[v[1]] < 0.) == (levels[v[2]] < 0.);
      if (!all)
        return true;
      if (leaf.kind == Kind::affine)
        return false;
      const auto  &points = part.surface.points;
      const double length = longest({{points[v[0]], points[v[1]], points[v[2]]}});
      if (is_distance(leaf))
        return std::abs(levels[v[0]]) <= length;
      return length > scale.spacing_for(leaf);
    }
  } // namespace

  CutScale::CutScale(const SurfaceMesh &surface)
  {
    Point<3> lower = surface.points[surface.triangles[0][0]], upper = lower;
    for (const auto &triangle : surface.triangles)
      for (const unsigned int v : triangle)
        for (unsigned int d = 0; d < 3; ++d)
          {
            lower[d] = std::min(lower[d], surface.points[v][d]);
            upper[d] = std::max(upper[d], surface.points[v][d]);
          }
    double body = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      body = std::max(body, upper[d] - lower[d]);
    snap    = same_point * body;
    spacing = scan_distance * body;
  }

  double
  CutScale::spacing_for(const core::ConditionLeaf &leaf) const
  {
    if (leaf.kind != Kind::sphere && leaf.kind != Kind::cylinder)
      return spacing;
    return std::min(spacing, std::max(.25 * leaf.radius, snap));
  }

  double
  PartOfSurface::longest_edge() const
  {
    double result = 0.;
    for (const unsigned int t : triangles())
      {
        const auto &v = surface.triangles[t];
        result
          = std::max(result,
                     longest({{surface.points[v[0]], surface.points[v[1]], surface.points[v[2]]}}));
      }
    return result;
  }

  Point<3>
  PartOfSurface::foot(const OutlineSide &side, const Point<3> &point) const
  {
    const Point<3>    &a    = surface.points[side.first];
    const Tensor<1, 3> edge = surface.points[side.second] - a;
    const double       t    = ((point - a) * edge) / edge.norm_square();
    return t <= 0. ? a : t >= 1. ? surface.points[side.second] : a + t * edge;
  }

  double
  PartOfSurface::distance(const OutlineSide &side, const Point<3> &point) const
  {
    return point.distance(foot(side, point));
  }

  bool
  PartOfSurface::contains(const Point<3> &point, const double tolerance) const
  {
    for (const OutlineSide &side : outline())
      if (distance(side, point) <= tolerance)
        return false;
    const auto &points = surface.points;
    return std::any_of(triangles().begin(), triangles().end(), [&](const auto t) {
      const auto &v = surface.triangles[t];
      for (unsigned int i = 0; i < 3; ++i)
        {
          const Tensor<1, 3> edge = points[v[(i + 1) % 3]] - points[v[i]];
          if (dealii::cross_product_3d(edge, point - points[v[i]]) * normal()
              < -tolerance * edge.norm())
            return false;
        }
      return true;
    });
  }

  std::vector<BorderCurve>
  border_curves(const PartOfSurface       &part,
                const core::ConditionLeaf &leaf,
                const std::vector<double> &levels,
                const CutScale            &scale)
  {
    const auto crosses
      = [&](const unsigned int t) { return may_cross(part, t, leaf, levels, scale); };
    if (leaf.kind == Kind::constant
        || std::none_of(part.triangles().begin(), part.triangles().end(), crosses))
      return {};
    if (leaf.kind == Kind::affine)
      return straight_lines(part, leaf, levels, scale.snap);
    Marching marching(leaf, scale);
    for (const unsigned int t : part.triangles())
      {
        const auto &v      = part.surface.triangles[t];
        const auto &points = part.surface.points;
        marching.visit({{points[v[0]], points[v[1]], points[v[2]]}},
                       {{levels[v[0]], levels[v[1]], levels[v[2]]}});
      }
    return marching.curves();
  }
} // namespace tetradapt::geometry
