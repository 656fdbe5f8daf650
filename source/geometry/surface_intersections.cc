// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/geometry/surface_intersections.h"

#include "tetradapt/core/exceptions.h"

#include "cgal_surface.h"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include <algorithm>
#include <iterator>

namespace tetradapt::geometry
{
  CgalSurface
  to_cgal(const SurfaceMesh &surface)
  {
    CgalSurface result;
    result.reserve(surface.points.size(),
                   3 * surface.triangles.size() / 2,
                   surface.triangles.size());
    for (const auto &p : surface.points)
      result.add_vertex(CgalPoint(p[0], p[1], p[2]));
    for (const auto &t : surface.triangles)
      if (result.add_face(CgalSurface::Vertex_index(t[0]),
                          CgalSurface::Vertex_index(t[1]),
                          CgalSurface::Vertex_index(t[2]))
          == CgalSurface::null_face())
        throw core::InputError("The surface's triangles do not form an oriented manifold.");
    return result;
  }

  std::vector<std::pair<unsigned int, unsigned int>>
  self_intersections(const SurfaceMesh &surface)
  {
    const CgalSurface mesh = to_cgal(surface);
    std::vector<std::pair<CgalSurface::Face_index, CgalSurface::Face_index>> pairs;
    CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));

    std::vector<std::pair<unsigned int, unsigned int>> result;
    for (const auto &[a, b] : pairs)
      {
        const unsigned int i = a.idx(), j = b.idx();
        result.emplace_back(std::min(i, j), std::max(i, j));
      }
    std::sort(result.begin(), result.end());
    return result;
  }

  bool
  encloses(const SurfaceMesh &surface, const Point<3> &point)
  {
    const CgalSurface                                          mesh = to_cgal(surface);
    const CGAL::Side_of_triangle_mesh<CgalSurface, CgalKernel> side(mesh);
    return side(CgalPoint(point[0], point[1], point[2])) == CGAL::ON_BOUNDED_SIDE;
  }
} // namespace tetradapt::geometry
