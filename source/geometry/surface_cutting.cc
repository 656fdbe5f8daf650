// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/geometry/surface_cutting.h"

#include "border_search.h"
#include "part_cutting.h"
#include "place_search.h"

#include <algorithm>
#include <set>

namespace tetradapt::geometry
{
  namespace
  {
    /** By the local size: what a mesh should not have to resolve. */
    constexpr double short_edge = 1e-2;

    /** Of a line that is cut into one flat part. */
    constexpr std::size_t most_pieces = 10000;

    class Cutting
    {
    public:
      Cutting(const SurfaceMesh                             &surface,
              const std::vector<SurfaceCut>                 &cuts,
              const std::function<double(const Point<3> &)> &local_size)
        : surface(surface), cuts(cuts), local_size(local_size), scale(surface),
          parts(find_flat_parts(surface)), points(scale.snap), lines(parts.triangles.size())
      {
      }

      /** Whether there is any border. */
      bool
      find_borders()
      {
        bool any = false;
        for (unsigned int c = 0; c < cuts.size(); ++c)
          {
            const BorderSearch search(surface, parts, cuts[c].condition, scale, local_size);
            for (unsigned int part = 0; part < parts.triangles.size(); ++part)
              if (cuts[c].concerns(id_of(part)))
                for (auto &line : search.in_part(part))
                  {
                    add_line(part, c, line);
                    any = true;
                  }
          }
        sort_cuts();
        return any;
      }

      /** Whether any of them touches the surface where it has no point or edge. */
      bool
      find_places(const std::vector<SurfacePlace> &places)
      {
        bool any = false;
        for (const SurfacePlace &place : places)
          for (unsigned int part = 0; part < parts.triangles.size(); ++part)
            {
              const PartOfSurface view{surface, parts, part};
              for (const auto &piece : place_in_part(view, place, scale.snap))
                if (piece.size() > 1)
                  {
                    add_line(part, cuts.size(), piece);
                    any = true;
                  }
                else if (const unsigned int p = number(view, cuts.size(), piece.front());
                         p >= surface.points.size())
                  {
                    lines[part].push_back({p});
                    any = true;
                  }
            }
        sort_cuts();
        if (any)
          for (unsigned int part = 0; part < parts.triangles.size(); ++part)
            shorten_lines(part);
        return any;
      }

      CutSurface
      triangulate()
      {
        CutSurface result;
        for (unsigned int part = 0; part < parts.triangles.size(); ++part)
          {
            const PartOfSurface view{surface, parts, part};
            const auto         &outline = view.outline();
            const bool          is_cut
              = !lines[part].empty()
                || std::any_of(outline.begin(), outline.end(), [&](const OutlineSide &side) {
                     return edge_cuts.count({side.first, side.second}) > 0;
                   });
            if (is_cut)
              {
                const auto triangles
                  = triangulate_with_cuts(view, edge_cuts, lines[part], scale.snap, points);
                for (const auto &triangle : triangles)
                  add_triangle(result, triangle, id_of(part), CutSurface::nothing);
                report_short_edges(triangles, view.longest_edge(), result);
              }
            else
              for (const unsigned int t : view.triangles())
                add_triangle(result, surface.triangles[t], id_of(part), t);
          }
        result.mesh.points = points.points();
        return result;
      }

    private:
      int
      id_of(const unsigned int part) const
      {
        return surface.ids.empty() ? 0 : surface.ids[parts.triangles[part].front()];
      }

      static void
      add_triangle(CutSurface                        &result,
                   const std::array<unsigned int, 3> &triangle,
                   const int                          id,
                   const unsigned int                 origin)
      {
        result.mesh.triangles.push_back(triangle);
        result.mesh.ids.push_back(id);
        result.origin.push_back(origin);
      }

      /** The number of a point in a part, which is moved onto the outline if it is near, and
       * then becomes one of it. */
      unsigned int
      number(const PartOfSurface &part, const unsigned int cut, const Point<3> &near)
      {
        if (points.points().empty())
          for (const Point<3> &old : surface.points)
            points.add(old);
        Point<3>           point    = near;
        const OutlineSide *on       = nullptr;
        double             distance = scale.snap;
        for (const OutlineSide &side : part.outline())
          if (const Point<3> foot = part.foot(side, near); foot.distance(near) <= distance)
            {
              distance = foot.distance(near);
              point    = foot;
              on       = &side;
            }
        const unsigned int n_before = points.points().size();
        const unsigned int number   = points.number(point);
        if (number < surface.points.size())
          return number;
        if (on != nullptr)
          {
            auto &on_edge = edge_cuts[{on->first, on->second}];
            if (std::find(on_edge.begin(), on_edge.end(), number) == on_edge.end())
              on_edge.push_back(number);
          }
        if (number == n_before)
          cut_of_point.push_back(cut);
        return number;
      }

      void
      add_line(const unsigned int part, const unsigned int cut, const std::vector<Point<3>> &line)
      {
        const PartOfSurface       view{surface, parts, part};
        std::vector<unsigned int> numbers;
        for (const Point<3> &point : line)
          {
            const unsigned int p = number(view, cut, point);
            if (numbers.empty() || numbers.back() != p)
              numbers.push_back(p);
          }
        if (numbers.size() > 1)
          lines[part].push_back(numbers);
      }

      /** Divides the lines of a part until no other point of it lies in the sphere about any of
       * their pieces. */
      void
      shorten_lines(const unsigned int part)
      {
        if (lines[part].empty())
          return;
        std::set<unsigned int> others;
        for (const unsigned int t : parts.triangles[part])
          others.insert(surface.triangles[t].begin(), surface.triangles[t].end());
        for (const auto &line : lines[part])
          others.insert(line.begin(), line.end());
        for (const OutlineSide &side : parts.outlines[part])
          if (const auto found = edge_cuts.find({side.first, side.second});
              found != edge_cuts.end())
            others.insert(found->second.begin(), found->second.end());
        for (auto &line : lines[part])
          for (std::size_t i = 1; i < line.size() && line.size() < most_pieces;)
            {
              const Point<3>     a = points.points()[line[i - 1]], b = points.points()[line[i]];
              const Tensor<1, 3> edge = b - a;
              double             at   = -1.;
              for (const unsigned int p : others)
                if (const Tensor<1, 3> from = points.points()[p] - a, to = points.points()[p] - b;
                    p != line[i - 1] && p != line[i] && from * to < 0.)
                  {
                    at = from * edge / edge.norm_square();
                    break;
                  }
              if (at < 0.)
                {
                  ++i;
                  continue;
                }
              const unsigned int middle = points.number(a + (at > .2 && at < .8 ? at : .5) * edge);
              if (middle == line[i - 1] || middle == line[i])
                {
                  ++i; // as short as points can be told apart
                  continue;
                }
              line.insert(line.begin() + i, middle);
              others.insert(middle);
            }
      }

      void
      sort_cuts()
      {
        for (auto &[edge, on_edge] : edge_cuts)
          std::sort(on_edge.begin(), on_edge.end(), [&, a = edge.first](auto p, auto q) {
            return surface.points[a].distance(points.points()[p])
                   < surface.points[a].distance(points.points()[q]);
          });
      }

      /** Those between two points of which one at least is new. */
      void
      report_short_edges(const std::vector<std::array<unsigned int, 3>> &triangles,
                         const double                                    longest_edge,
                         CutSurface                                     &result) const
      {
        const auto &p = points.points();
        for (const auto &triangle : triangles)
          for (unsigned int i = 0; i < 3; ++i)
            {
              const unsigned int a = triangle[i], b = triangle[(i + 1) % 3];
              const std::size_t  newer = std::max(a, b);
              if (a > b || newer < surface.points.size())
                continue;
              const Point<3> middle = p[a] + .5 * (p[b] - p[a]);
              const double   length = p[a].distance(p[b]);
              const double   size   = std::min(local_size(middle), longest_edge);
              if (length >= short_edge * size)
                continue;
              const std::size_t k = newer - surface.points.size();
              result.short_edges.push_back({k < cut_of_point.size() && cut_of_point[k] < cuts.size()
                                              ? cuts[cut_of_point[k]].name
                                              : "",
                                            length,
                                            size,
                                            middle});
            }
      }

      const SurfaceMesh                                  &surface;
      const std::vector<SurfaceCut>                      &cuts;
      const std::function<double(const Point<3> &)>      &local_size;
      const CutScale                                      scale;
      const FlatPartList                                  parts;
      PointMerger                                         points;
      std::vector<std::vector<std::vector<unsigned int>>> lines; ///< of each part
      EdgeCuts                                            edge_cuts;
      std::vector<unsigned int>                           cut_of_point; ///< of each new one
    };
  } // namespace

  CutSurface
  cut_surface(const SurfaceMesh                             &surface,
              const std::vector<SurfaceCut>                 &cuts,
              const std::function<double(const Point<3> &)> &local_size,
              const std::vector<SurfacePlace>               &places)
  {
    Cutting    cutting(surface, cuts, local_size);
    const bool has_borders = cutting.find_borders();
    if (cutting.find_places(places) || has_borders)
      return cutting.triangulate();
    CutSurface whole;
    whole.mesh = surface;
    whole.origin.resize(surface.triangles.size());
    for (unsigned int t = 0; t < whole.origin.size(); ++t)
      whole.origin[t] = t;
    return whole;
  }

  double
  snap_distance(const SurfaceMesh &surface)
  {
    return CutScale(surface).snap;
  }
} // namespace tetradapt::geometry
