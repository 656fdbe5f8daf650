// SPDX-License-Identifier: AGPL-3.0-or-later
#include "part_cutting.h"

#include "axis_plane.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/surface_topology.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace tetradapt::geometry
{
  namespace
  {
    using Plane    = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Vertex   = CGAL::Triangulation_vertex_base_with_info_2<unsigned int, Plane>;
    using Face     = CGAL::Constrained_triangulation_face_base_2<Plane>;
    using Marked   = CGAL::Triangulation_face_base_with_info_2<bool, Plane, Face>;
    using Storage  = CGAL::Triangulation_data_structure_2<Vertex, Marked>;
    using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Plane, //
                                                                Storage,
                                                                CGAL::Exact_predicates_tag>;

    class PartTriangulation
    {
    public:
      PartTriangulation(const PartOfSurface &part, const double snap, PointMerger &points)
        : part(part), plane(part.normal()), snap(snap), points(points)
      {
      }

      void
      add_outline(const EdgeCuts &cuts)
      {
        for (const OutlineSide &side : part.outline())
          {
            unsigned int last  = side.first;
            const auto   found = cuts.find({side.first, side.second});
            if (found != cuts.end())
              for (const unsigned int p : found->second)
                {
                  add_outline_edge(last, p);
                  last = p;
                }
            add_outline_edge(last, side.second);
          }
      }

      void
      add_inner_points()
      {
        for (const unsigned int t : part.triangles())
          for (const unsigned int p : part.surface.triangles[t])
            vertex(p);
      }

      void
      add_lines(const std::vector<std::vector<unsigned int>> &lines)
      {
        // All points first, so that lines are led through those that they pass.
        for (const auto &line : lines)
          for (const unsigned int p : line)
            vertex(p);
        for (const auto &line : lines)
          for (std::size_t i = 1; i < line.size(); ++i)
            add_line(line[i - 1], line[i]);
      }

      std::vector<std::array<unsigned int, 3>>
      triangles()
      {
        mark_outside();
        double                                   area = 0.;
        std::vector<std::array<unsigned int, 3>> result;
        for (const auto face : triangulation.finite_face_handles())
          if (!face->info())
            {
              std::array<unsigned int, 3> t{};
              for (unsigned int i = 0; i < 3; ++i)
                t[i] = number_of(face->vertex(i));
              area += triangle_area(t, points.points());
              result.push_back(t);
            }
        double old_area = 0.;
        for (const unsigned int t : part.triangles())
          old_area += triangle_area(part.surface.triangles[t], part.surface.points);
        if (!(std::abs(area - old_area) <= 1e-6 * old_area))
          throw core::NumericalError("A flat part of a surface around "
                                     + to_string(points.points()[handles.begin()->first])
                                     + " could not be cut along the border of a selection.");
        return result;
      }

    private:
      static double
      triangle_area(const std::array<unsigned int, 3> &t, const std::vector<Point<3>> &p)
      {
        return .5 * dealii::cross_product_3d(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).norm();
      }

      Delaunay::Vertex_handle
      vertex(const unsigned int point)
      {
        auto &handle = handles[point];
        if (handle == nullptr)
          {
            const auto uv  = plane(points.points()[point]);
            handle         = triangulation.insert({uv[0], uv[1]});
            handle->info() = point;
            is_known.insert(handle);
          }
        return handle;
      }

      /** Where lines cross, the triangulation makes points itself. */
      unsigned int
      number_of(const Delaunay::Vertex_handle handle)
      {
        if (is_known.insert(handle).second)
          {
            const auto    &uv = handle->point();
            const Point<3> origin
              = part.surface.points[part.surface.triangles[part.triangles()[0]][0]];
            const Point<3> place = plane.lift({{uv.x(), uv.y()}}, origin);
            for (const OutlineSide &side : part.outline())
              if (part.distance(side, place) <= snap)
                throw core::NumericalError("Borders of selections cross the edge of a surface at "
                                           + to_string(place) + " and could not be cut.");
            handle->info() = points.add(place);
          }
        return handle->info();
      }

      void
      add_outline_edge(const unsigned int a, const unsigned int b)
      {
        ++outline_edges[std::minmax(a, b)];
        triangulation.insert_constraint(vertex(a), vertex(b));
      }

      void
      add_line(const unsigned int a, const unsigned int b)
      {
        const auto                                  &all  = points.points();
        const Tensor<1, 3>                           edge = all[b] - all[a];
        std::vector<std::pair<double, unsigned int>> passed{{0., a}, {1., b}};
        for (const auto &[p, handle] : handles)
          {
            const double t = ((all[p] - all[a]) * edge) / edge.norm_square();
            if (p != a && p != b && t > 0. && t < 1. && all[p].distance(all[a] + t * edge) <= snap)
              passed.emplace_back(t, p);
          }
        std::sort(passed.begin(), passed.end());
        for (std::size_t i = 1; i < passed.size(); ++i)
          if (n_sides(passed[i - 1].second, passed[i].second) == 0)
            triangulation.insert_constraint(vertex(passed[i - 1].second), vertex(passed[i].second));
      }

      /** What is reached from outside by crossing the outline an even number of times. */
      void
      mark_outside()
      {
        std::set<Delaunay::Face_handle>                     seen{triangulation.infinite_face()};
        std::vector<std::pair<Delaunay::Face_handle, bool>> stack{
          {triangulation.infinite_face(), true}};
        while (!stack.empty())
          {
            const auto [face, outside] = stack.back();
            stack.pop_back();
            face->info() = outside;
            for (int i = 0; i < 3; ++i)
              {
                const auto next = face->neighbor(i);
                if (seen.insert(next).second)
                  stack.emplace_back(next, outside != is_outline(face, i));
              }
          }
      }

      /** On how many sides of an edge the part ends there: two for a slit, such as where
       * a wall between regions ends inside it. */
      unsigned int
      n_sides(const unsigned int a, const unsigned int b) const
      {
        const auto found = outline_edges.find(std::minmax(a, b));
        return found == outline_edges.end() ? 0 : found->second;
      }

      bool
      is_outline(const Delaunay::Face_handle face, const int i) const
      {
        const auto a = face->vertex(Delaunay::cw(i)), b = face->vertex(Delaunay::ccw(i));
        return !triangulation.is_infinite(a) && !triangulation.is_infinite(b)
               && is_known.count(a) > 0 && is_known.count(b) > 0
               && n_sides(a->info(), b->info()) % 2 == 1;
      }

      const PartOfSurface                                          &part;
      const AxisPlane                                               plane;
      const double                                                  snap;
      PointMerger                                                  &points;
      Delaunay                                                      triangulation;
      std::map<unsigned int, Delaunay::Vertex_handle>               handles;
      std::set<Delaunay::Vertex_handle>                             is_known;
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> outline_edges;
    };
  } // namespace

  std::vector<std::array<unsigned int, 3>>
  triangulate_with_cuts(const PartOfSurface                          &part,
                        const EdgeCuts                               &cuts,
                        const std::vector<std::vector<unsigned int>> &lines,
                        const double                                  snap,
                        PointMerger                                  &points)
  {
    PartTriangulation triangulation(part, snap, points);
    triangulation.add_outline(cuts);
    triangulation.add_inner_points();
    triangulation.add_lines(lines);
    return triangulation.triangles();
  }
} // namespace tetradapt::geometry
