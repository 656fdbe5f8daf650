// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/geometry/nearest_surface.h"

#include "cgal_surface.h"

#include <CGAL/AABB_tree.h>
#include <CGAL/version.h>
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_segment_primitive_3.h>
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <cmath>
#include <vector>

namespace tetradapt::geometry
{
  namespace
  {
    using Triangles = std::vector<CgalKernel::Triangle_3>;
    using Segments  = std::vector<CgalKernel::Segment_3>;
#if CGAL_VERSION_NR >= 1060000000
    using TrianglePrimitive
      = CGAL::AABB_triangle_primitive_3<CgalKernel, Triangles::const_iterator>;
    using SegmentPrimitive = CGAL::AABB_segment_primitive_3<CgalKernel, Segments::const_iterator>;
    using TriangleTree     = CGAL::AABB_tree<CGAL::AABB_traits_3<CgalKernel, TrianglePrimitive>>;
    using SegmentTree      = CGAL::AABB_tree<CGAL::AABB_traits_3<CgalKernel, SegmentPrimitive>>;
#else
    using TrianglePrimitive = CGAL::AABB_triangle_primitive<CgalKernel, Triangles::const_iterator>;
    using SegmentPrimitive  = CGAL::AABB_segment_primitive<CgalKernel, Segments::const_iterator>;
    using TriangleTree      = CGAL::AABB_tree<CGAL::AABB_traits<CgalKernel, TrianglePrimitive>>;
    using SegmentTree       = CGAL::AABB_tree<CGAL::AABB_traits<CgalKernel, SegmentPrimitive>>;
#endif

    CgalPoint
    to_cgal(const Point<3> &p)
    {
      return {p[0], p[1], p[2]};
    }

    Point<3>
    from_cgal(const CgalPoint &p)
    {
      return {p.x(), p.y(), p.z()};
    }

    Tensor<1, 3>
    unit_normal(const CgalKernel::Triangle_3 &triangle)
    {
      const auto   v = CGAL::cross_product(triangle[1] - triangle[0], triangle[2] - triangle[0]);
      Tensor<1, 3> normal;
      for (unsigned int d = 0; d < 3; ++d)
        normal[d] = v[d];
      return normal / normal.norm();
    }
  } // namespace

  struct NearestSurface::Implementation
  {
    Triangles    triangles;
    Segments     creases;
    TriangleTree triangle_tree;
    SegmentTree  crease_tree;
  };

  NearestSurface::NearestSurface(const SurfaceMesh &surface, double crease_angle)
    : implementation(std::make_unique<Implementation>())
  {
    auto &data = *implementation;
    data.triangles.reserve(surface.triangles.size());
    for (const auto &t : surface.triangles)
      data.triangles.emplace_back(to_cgal(surface.points[t[0]]),
                                  to_cgal(surface.points[t[1]]),
                                  to_cgal(surface.points[t[2]]));
    const CgalSurface mesh         = geometry::to_cgal(surface);
    const double      least_cosine = std::cos(crease_angle * M_PI / 180.);
    for (const auto edge : mesh.edges())
      {
        const auto half  = mesh.halfedge(edge);
        const auto left  = unit_normal(data.triangles[mesh.face(half).idx()]);
        const auto right = unit_normal(data.triangles[mesh.face(mesh.opposite(half)).idx()]);
        if (left * right < least_cosine)
          data.creases.emplace_back(mesh.point(mesh.vertex(edge, 0)),
                                    mesh.point(mesh.vertex(edge, 1)));
      }
    data.triangle_tree.insert(data.triangles.cbegin(), data.triangles.cend());
    data.triangle_tree.accelerate_distance_queries();
    if (!data.creases.empty())
      {
        data.crease_tree.insert(data.creases.cbegin(), data.creases.cend());
        data.crease_tree.accelerate_distance_queries();
      }
  }

  NearestSurface::~NearestSurface() = default;

  NearestSurface::Foot
  NearestSurface::nearest(const Point<3> &point) const
  {
    const auto found = implementation->triangle_tree.closest_point_and_primitive(to_cgal(point));
    return {from_cgal(found.first), unit_normal(*found.second)};
  }

  std::optional<Point<3>>
  NearestSurface::nearest_on_crease(const Point<3> &point) const
  {
    if (implementation->creases.empty())
      return std::nullopt;
    return from_cgal(implementation->crease_tree.closest_point(to_cgal(point)));
  }
} // namespace tetradapt::geometry
