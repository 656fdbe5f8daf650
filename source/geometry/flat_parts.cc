// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/geometry/flat_parts.h"

#include "axis_plane.h"
#include "flat_part_search.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/surface_topology.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tetradapt::geometry
{
  namespace
  {
    using dealii::Tensor;
    using Side  = OutlineSide;
    using Parts = FlatPartList;

    constexpr double flat = flat_sine;

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
            const auto uv = plane(surface.points[point]);
            handle = triangulation.insert({uv[0], uv[1]});
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
    data.parts   = find_flat_parts(surface);
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
