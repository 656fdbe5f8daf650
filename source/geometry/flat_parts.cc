// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/geometry/flat_parts.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/surface_topology.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <tuple>

namespace tetradapt::geometry
{
  namespace
  {
    using dealii::Tensor;

    /** Sine of the angle up to which planes and lines are taken for one: above the
     * rounding of points that were inserted, below any curvature that is meant. */
    constexpr double flat = 1e-8;

    constexpr unsigned int nothing = std::numeric_limits<unsigned int>::max();

    /** An edge of a triangle. */
    struct Side
    {
      unsigned int first, second; ///< smaller point number first
      unsigned int triangle;

      bool
      operator<(const Side &other) const
      {
        return std::tie(first, second, triangle)
               < std::tie(other.first, other.second, other.triangle);
      }
      bool
      same_edge(const Side &other) const
      {
        return first == other.first && second == other.second;
      }
    };

    /** Which triangles lie in one plane, and the edges between such parts. */
    struct Parts
    {
      std::vector<unsigned int>              of_triangle;
      std::vector<std::vector<unsigned int>> triangles; ///< of each part
      std::vector<Tensor<1, 3>>              normals;   ///< of each part
      std::vector<std::vector<Side>>         outlines;  ///< of each part; triangle: any of it
      /** Ends of outline edges: per point its neighbours along outlines, each once. */
      std::vector<std::vector<unsigned int>> outline_neighbours;
    };

    Tensor<1, 3>
    unit_normal(const SurfaceMesh &surface, unsigned int triangle)
    {
      const auto &t = surface.triangles[triangle];
      const auto  n = dealii::cross_product_3d(surface.points[t[1]] - surface.points[t[0]],
                                              surface.points[t[2]] - surface.points[t[0]]);
      return n / n.norm();
    }

    std::vector<Side>
    sorted_sides(const SurfaceMesh &surface)
    {
      std::vector<Side> sides;
      sides.reserve(3 * surface.triangles.size());
      for (unsigned int t = 0; t < surface.triangles.size(); ++t)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int a = surface.triangles[t][i], b = surface.triangles[t][(i + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), t});
          }
      std::sort(sides.begin(), sides.end());
      return sides;
    }

    /** For each triangle the ones across its edges with the same id, where just two meet. */
    std::vector<std::array<unsigned int, 3>>
    neighbours(const SurfaceMesh &surface, const std::vector<Side> &sides)
    {
      std::vector<std::array<unsigned int, 3>> result(surface.triangles.size(),
                                                      {{nothing, nothing, nothing}});
      const auto                               put = [&](unsigned int t, unsigned int other) {
        *std::find(result[t].begin(), result[t].end(), nothing) = other;
      };
      for (std::size_t i = 0, next; i < sides.size(); i = next)
        {
          for (next = i + 1; next < sides.size() && sides[next].same_edge(sides[i]);)
            ++next;
          if (next != i + 2
              || (!surface.ids.empty()
                  && surface.ids[sides[i].triangle] != surface.ids[sides[i + 1].triangle]))
            continue;
          put(sides[i].triangle, sides[i + 1].triangle);
          put(sides[i + 1].triangle, sides[i].triangle);
        }
      return result;
    }

    Parts
    find_parts(const SurfaceMesh &surface)
    {
      const auto sides = sorted_sides(surface);
      const auto next  = neighbours(surface, sides);
      Parts      parts;
      parts.of_triangle.assign(surface.triangles.size(), nothing);
      for (unsigned int seed = 0; seed < surface.triangles.size(); ++seed)
        {
          if (parts.of_triangle[seed] != nothing)
            continue;
          // Compared with the first triangle, so that slow curvature does not add up.
          const Tensor<1, 3>       normal = unit_normal(surface, seed);
          std::deque<unsigned int> queue{seed};
          parts.of_triangle[seed] = parts.triangles.size();
          parts.triangles.emplace_back();
          parts.normals.push_back(normal);
          for (; !queue.empty(); queue.pop_front())
            {
              parts.triangles.back().push_back(queue.front());
              for (const unsigned int t : next[queue.front()])
                if (t != nothing && parts.of_triangle[t] == nothing)
                  {
                    const Tensor<1, 3> other = unit_normal(surface, t);
                    if (normal * other < 0.
                        || dealii::cross_product_3d(normal, other).norm() > flat)
                      continue;
                    parts.of_triangle[t] = parts.triangles.size() - 1;
                    queue.push_back(t);
                  }
            }
        }
      parts.outlines.resize(parts.triangles.size());
      parts.outline_neighbours.resize(surface.points.size());
      for (std::size_t i = 0, end; i < sides.size(); i = end)
        {
          for (end = i + 1; end < sides.size() && sides[end].same_edge(sides[i]);)
            ++end;
          if (end == i + 2
              && parts.of_triangle[sides[i].triangle] == parts.of_triangle[sides[i + 1].triangle])
            continue;
          for (std::size_t k = i; k < end; ++k)
            parts.outlines[parts.of_triangle[sides[k].triangle]].push_back(sides[k]);
          parts.outline_neighbours[sides[i].first].push_back(sides[i].second);
          parts.outline_neighbours[sides[i].second].push_back(sides[i].first);
        }
      return parts;
    }

    /** Whether all outlines through a point are one straight line. */
    bool
    is_passed_straight(const SurfaceMesh               &surface,
                       unsigned int                     point,
                       const std::vector<unsigned int> &along)
    {
      if (along.size() != 2)
        return false;
      const Tensor<1, 3> a = surface.points[along[0]] - surface.points[point];
      const Tensor<1, 3> b = surface.points[along[1]] - surface.points[point];
      return a * b < 0. && dealii::cross_product_3d(a, b).norm() <= flat * a.norm() * b.norm();
    }

    using Plane    = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Vertex   = CGAL::Triangulation_vertex_base_with_info_2<unsigned int, Plane>;
    using Face     = CGAL::Constrained_triangulation_face_base_2<Plane>;
    using Marked   = CGAL::Triangulation_face_base_with_info_2<int, Plane, Face>;
    using Storage  = CGAL::Triangulation_data_structure_2<Vertex, Marked>;
    using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<
      Plane,
      Storage,
      CGAL::No_constraint_intersection_requiring_constructions_tag>;

    constexpr int unknown = -1;

    /** How many outlines separate each triangle from the outside. */
    void
    count_outlines(Delaunay &triangulation)
    {
      for (const auto face : triangulation.all_face_handles())
        face->info() = unknown;
      std::vector<Delaunay::Face_handle> here{triangulation.infinite_face()}, behind;
      for (int level = 0; !here.empty(); ++level, here.swap(behind), behind.clear())
        while (!here.empty())
          {
            const auto face = here.back();
            here.pop_back();
            if (face->info() != unknown)
              continue;
            face->info() = level;
            for (int i = 0; i < 3; ++i)
              if (face->neighbor(i)->info() == unknown)
                (face->is_constrained(i) ? behind : here).push_back(face->neighbor(i));
          }
    }

    /** Turns points into the coordinates of a plane that looks along an axis. */
    class AxisPlane
    {
    public:
      explicit AxisPlane(const Tensor<1, 3> &normal)
      {
        unsigned int d = 0;
        for (unsigned int k = 1; k < 3; ++k)
          if (std::abs(normal[k]) > std::abs(normal[d]))
            d = k;
        first  = (d + 1) % 3;
        second = (d + 2) % 3;
        if (normal[d] < 0.)
          std::swap(first, second);
      }

      Plane::Point_2
      operator()(const Point<3> &p) const
      {
        return {p[first], p[second]};
      }

    private:
      unsigned int first, second;
    };

    double
    area(const SurfaceMesh &surface, const std::array<unsigned int, 3> &t)
    {
      return 0.5
             * dealii::cross_product_3d(surface.points[t[1]] - surface.points[t[0]],
                                        surface.points[t[2]] - surface.points[t[0]])
                 .norm();
    }

    /** The point at the other end of an outline that begins with the edge from @p a to
     * @p b, points that it passes straight left out. */
    unsigned int
    end_of_line(const Parts             &parts,
                const std::vector<bool> &dropped,
                unsigned int             a,
                unsigned int             b)
    {
      while (dropped[b])
        {
          const auto        &along = parts.outline_neighbours[b];
          const unsigned int next  = along[0] == a ? along[1] : along[0];
          a                        = b;
          b                        = next;
        }
      return b;
    }

    /** Appends the triangles between the corners of one flat part. */
    void
    triangulate_part(const SurfaceMesh            &surface,
                     const Parts                  &parts,
                     const std::vector<PointKind> &kinds,
                     const std::vector<bool>      &dropped,
                     unsigned int                  part,
                     SurfaceMesh                  &result)
    {
      const AxisPlane                                 plane(parts.normals[part]);
      Delaunay                                        triangulation;
      std::map<unsigned int, Delaunay::Vertex_handle> vertex;
      const auto                                      insert = [&](unsigned int point) {
        auto &handle = vertex[point];
        if (handle == nullptr)
          {
            handle = triangulation.insert(plane(surface.points[point]));
            handle->info() = point;
          }
        return handle;
      };
      for (const Side &side : parts.outlines[part])
        for (const auto &[a, b] :
             {std::make_pair(side.first, side.second), std::make_pair(side.second, side.first)})
          if (!dropped[a])
            triangulation.insert_constraint(insert(a), insert(end_of_line(parts, dropped, a, b)));
      for (const unsigned int t : parts.triangles[part])
        for (const unsigned int p : surface.triangles[t])
          if (kinds[p] == PointKind::flat && !dropped[p])
            insert(p);
      count_outlines(triangulation);

      double new_area = 0., old_area = 0.;
      for (const auto face : triangulation.finite_face_handles())
        if (face->info() % 2 == 1)
          {
            result.triangles.push_back(
              {{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()}});
            new_area += area(surface, result.triangles.back());
            if (!surface.ids.empty())
              result.ids.push_back(surface.ids[parts.triangles[part].front()]);
          }
      for (const unsigned int t : parts.triangles[part])
        old_area += area(surface, surface.triangles[t]);
      if (!(std::abs(new_area - old_area) <= 1e-6 * old_area))
        throw core::NumericalError("A flat part of a surface around "
                                   + to_string(surface.points[vertex.begin()->first])
                                   + " could not be put together from larger triangles.");
    }
  } // namespace

  struct FlatParts::Implementation
  {
    SurfaceMesh            surface;
    Parts                  parts;
    std::vector<PointKind> kinds;
  };

  FlatParts::FlatParts(const SurfaceMesh &surface)
    : implementation(std::make_unique<Implementation>())
  {
    auto &data   = *implementation;
    data.surface = surface;
    data.parts   = find_parts(surface);
    data.kinds.assign(surface.points.size(), PointKind::unused);
    for (const auto &triangle : surface.triangles)
      for (const unsigned int p : triangle)
        {
          const auto &along = data.parts.outline_neighbours[p];
          data.kinds[p]     = along.empty()                           ? PointKind::flat
                              : is_passed_straight(surface, p, along) ? PointKind::line
                                                                      : PointKind::corner;
        }
  }

  FlatParts::~FlatParts() = default;

  const std::vector<PointKind> &
  FlatParts::point_kinds() const
  {
    return implementation->kinds;
  }

  SurfaceMesh
  FlatParts::triangulate(const std::vector<bool> &keep) const
  {
    const auto       &surface = implementation->surface;
    const auto       &parts   = implementation->parts;
    std::vector<bool> dropped(surface.points.size());
    for (unsigned int p = 0; p < surface.points.size(); ++p)
      dropped[p] = !keep[p] && implementation->kinds[p] != PointKind::corner;

    SurfaceMesh result;
    result.points = surface.points;
    for (unsigned int part = 0; part < parts.triangles.size(); ++part)
      if (parts.triangles[part].size() > 1)
        triangulate_part(surface, parts, implementation->kinds, dropped, part, result);
      else
        {
          const unsigned int t = parts.triangles[part].front();
          result.triangles.push_back(surface.triangles[t]);
          if (!surface.ids.empty())
            result.ids.push_back(surface.ids[t]);
        }
    return result;
  }
} // namespace tetradapt::geometry
