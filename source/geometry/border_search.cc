// SPDX-License-Identifier: AGPL-3.0-or-later
#include "border_search.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::geometry
{
  namespace
  {
    using Leaf = core::ConditionLeaf;
    using Kind = core::ConditionLeaf::Kind;

    /** Of a chord, by the local size. */
    constexpr double largest_sagitta = 1e-2;
    /** By the chord itself: it turns by 30 degrees. */
    constexpr double largest_turn = 0.065;
    /** By how many merging distances the two sides of a border are apart. */
    constexpr double       side_distance = 4.;
    constexpr unsigned int most_halvings = 10;

    Point<3>
    along(const Point<3> &a, const Point<3> &b, const double t)
    {
      return a + t * (b - a);
    }

    double
    distance_from_line(const Point<3> &p, const Point<3> &a, const Point<3> &b)
    {
      const Tensor<1, 3> edge = b - a;
      if (edge.norm_square() == 0.)
        return p.distance(a);
      return dealii::cross_product_3d(p - a, edge).norm() / edge.norm();
    }

    /**
     * Moves the inner points of a polyline whose points lie on a curve outward, so that the
     * chords enclose the area that the curve encloses: a chord of length c cuts off
     * k c^3/12 for the curvature k, and moving its ends by k c^2/12 gives that back. Where
     * a curve touches the outline of its part, its points stay.
     */
    void
    keep_area(std::vector<Point<3>> &points,
              const bool             closed,
              const PartOfSurface   &part,
              const double           snap)
    {
      const std::vector<Point<3>> old = points;
      const std::size_t           n   = old.size();
      for (std::size_t i = closed ? 0 : 1; i + 1 < n; ++i)
        {
          const Point<3>    &before = old[i == 0 ? n - 2 : i - 1], &after = old[i + 1];
          const double       a = before.distance(old[i]), b = after.distance(old[i]);
          const Tensor<1, 3> chord = (after - before) / after.distance(before);
          const Tensor<1, 3> arm   = old[i] - before;
          // k = 2 |height| / (a b), for the height of the point over the line between its
          // neighbours.
          const Tensor<1, 3> height = arm - (arm * chord) * chord;
          const Point<3>     moved  = old[i] + height * ((a * a + b * b) / (12. * a * b));
          if (part.contains(moved, snap))
            points[i] = moved;
        }
      if (closed)
        points.back() = points.front();
    }
  } // namespace

  BorderSearch::BorderSearch(const SurfaceMesh                             &surface,
                             const FlatPartList                            &parts,
                             const core::Condition                         &condition,
                             const CutScale                                &scale,
                             const std::function<double(const Point<3> &)> &local_size)
    : surface(surface), parts(parts), condition(condition), scale(scale), local_size(local_size)
  {
    for (const Leaf &leaf : condition.leaves())
      {
        levels.emplace_back();
        if (leaf.kind == Kind::constant)
          continue;
        levels.back().reserve(surface.points.size());
        for (const Point<3> &point : surface.points)
          levels.back().push_back(leaf.level(point));
      }
  }

  std::vector<std::vector<Point<3>>>
  BorderSearch::in_part(const unsigned int number) const
  {
    const PartOfSurface                part{surface, parts, number};
    std::vector<std::vector<Point<3>>> result;
    for (unsigned int i = 0; i < condition.leaves().size(); ++i)
      {
        const Leaf &leaf = condition.leaves()[i];
        const Track track{part, i, leaf.kind == Kind::affine};
        for (const BorderCurve &curve : border_curves(part, leaf, levels[i], scale))
          for (const BorderCurve &piece : pieces_on_border(track, curve))
            if (track.straight)
              result.push_back({piece.points.front(), piece.points.back()});
            else
              result.push_back(chords(track, piece));
      }
    return result;
  }

  std::vector<bool>
  BorderSearch::truths(const Point<3> &point) const
  {
    std::vector<bool> result;
    for (const Leaf &leaf : condition.leaves())
      result.push_back(leaf.level(point) < 0.);
    return result;
  }

  Point<3>
  BorderSearch::beside(const Track    &track,
                       const Point<3> &a,
                       const Point<3> &b,
                       const double    t) const
  {
    const Point<3> point = along(a, b, t);
    if (track.straight)
      return point;
    const Leaf        &leaf   = condition.leaves()[track.leaf];
    const Tensor<1, 3> across = .5 * dealii::cross_product_3d(track.part.normal(), b - a);
    const auto         holds
      = [&](const double s) { return leaf.level(point + (2. * s - 1.) * across) < 0.; };
    if (holds(0.) == holds(1.))
      return point;
    return point + (2. * change_of(holds) - 1.) * across;
  }

  Point<3>
  BorderSearch::inside(const Track    &track,
                       const Point<3> &a,
                       const Point<3> &b,
                       const double    t) const
  {
    const Point<3> point = beside(track, a, b, t);
    return track.straight || track.part.contains(point, scale.snap) ? point : along(a, b, t);
  }

  std::vector<double>
  BorderSearch::breaks(const Track &track, const Point<3> &a, const Point<3> &b) const
  {
    std::vector<double> result{0., 1.};
    const double        length = a.distance(b);
    for (unsigned int j = 0; j < condition.leaves().size(); ++j)
      {
        const Leaf &leaf = condition.leaves()[j];
        if (j == track.leaf || leaf.kind == Kind::constant)
          continue;
        // The sign of an affine leaf changes once on a line; a chord of a curved border is
        // as short as the spacing.
        const unsigned int n     = leaf.kind == Kind::affine
                                     ? 1
                                     : std::ceil(std::max(1., length / scale.spacing_for(leaf)));
        const auto         holds = [&](const double t) {
          return leaf.level(t == 0. ? a : t == 1. ? b : beside(track, a, b, t)) < 0.;
        };
        bool last = holds(0.);
        for (unsigned int k = 0; k < n; ++k)
          {
            const double from = double(k) / n, to = (k + 1.) / n;
            const bool   next = holds(to);
            if (next != last)
              result.push_back(from + (to - from) * change_of([&](const double s) {
                                        return holds(from + s * (to - from));
                                      }));
            last = next;
          }
      }
    std::sort(result.begin(), result.end());
    return result;
  }

  bool
  BorderSearch::is_border(const Track &track, const Point<3> &a, const Point<3> &b) const
  {
    const Point<3>     middle = beside(track, a, b, .5);
    const Tensor<1, 3> across = dealii::cross_product_3d(track.part.normal(), b - a);
    const Tensor<1, 3> step   = across * (side_distance * scale.snap / across.norm());
    return condition.combine(truths(middle + step)) != condition.combine(truths(middle - step));
  }

  std::vector<BorderCurve>
  BorderSearch::pieces_on_border(const Track &track, const BorderCurve &curve) const
  {
    std::vector<BorderCurve> runs;
    bool                     open  = false; // whether the last run goes on
    bool                     whole = true;
    for (std::size_t i = 1; i < curve.points.size(); ++i)
      {
        const Point<3> &a = curve.points[i - 1], &b = curve.points[i];
        const auto      t    = breaks(track, a, b);
        Point<3>        from = a;
        for (std::size_t k = 1; k < t.size(); ++k)
          {
            const bool     last = k + 1 == t.size();
            const Point<3> to   = last ? b : inside(track, a, b, t[k]);
            // What is as short as this cannot be told from its ends.
            if (from.distance(to) <= 2. * scale.snap)
              {
                if (last && open)
                  runs.back().points.back() = to;
                continue;
              }
            if (!is_border(track, from, to))
              {
                open  = false;
                whole = false;
              }
            else
              {
                if (!open)
                  runs.push_back({{from}, false});
                open = true;
                runs.back().points.push_back(to);
              }
            from = to;
          }
      }
    if (!curve.closed || runs.empty())
      return runs;
    if (whole && runs.size() == 1)
      runs.front().closed = true;
    else if (runs.size() > 1 && open
             && runs.front().points.front().distance(curve.points.front()) == 0.)
      {
        // The run through the place where the curve begins.
        auto &last = runs.back().points;
        last.insert(last.end(), runs.front().points.begin() + 1, runs.front().points.end());
        runs.erase(runs.begin());
      }
    return runs;
  }

  double
  BorderSearch::allowed_sagitta(const Track &track, const Point<3> &a, const Point<3> &b) const
  {
    const double size = std::min(local_size(along(a, b, .5)), track.part.longest_edge());
    return std::max(scale.snap, std::min(largest_sagitta * size, largest_turn * a.distance(b)));
  }

  void
  BorderSearch::add_halves(const Track           &track,
                           const Point<3>        &a,
                           const Point<3>        &b,
                           const unsigned int     depth,
                           std::vector<Point<3>> &result) const
  {
    const Point<3> middle = inside(track, a, b, .5);
    if (depth < most_halvings && middle.distance(along(a, b, .5)) > allowed_sagitta(track, a, b))
      {
        add_halves(track, a, middle, depth + 1, result);
        add_halves(track, middle, b, depth + 1, result);
      }
    else
      result.push_back(b);
  }

  void
  BorderSearch::add_chords(const Track                 &track,
                           const std::vector<Point<3>> &curve,
                           const std::size_t            begin,
                           const std::size_t            end,
                           std::vector<Point<3>>       &result) const
  {
    if (begin + 1 == end)
      {
        add_halves(track, curve[begin], curve[end], 0, result);
        return;
      }
    double farthest = 0.;
    for (std::size_t i = begin + 1; i < end; ++i)
      farthest = std::max(farthest, distance_from_line(curve[i], curve[begin], curve[end]));
    if (farthest <= allowed_sagitta(track, curve[begin], curve[end]))
      {
        result.push_back(curve[end]);
        return;
      }
    const std::size_t middle = (begin + end) / 2;
    add_chords(track, curve, begin, middle, result);
    add_chords(track, curve, middle, end, result);
  }

  std::vector<Point<3>>
  BorderSearch::chords(const Track &track, const BorderCurve &curve) const
  {
    std::vector<Point<3>> result{curve.points.front()};
    const std::size_t     last = curve.points.size() - 1;
    if (curve.closed && last >= 3)
      {
        add_chords(track, curve.points, 0, last / 3, result);
        add_chords(track, curve.points, last / 3, 2 * last / 3, result);
        add_chords(track, curve.points, 2 * last / 3, last, result);
      }
    else
      add_chords(track, curve.points, 0, last, result);
    keep_area(result, curve.closed, track.part, scale.snap);
    return result;
  }
} // namespace tetradapt::geometry
