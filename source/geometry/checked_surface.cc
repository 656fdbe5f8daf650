// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/geometry/checked_surface.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/surface_intersections.h"
#include "tetradapt/geometry/surface_topology.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::geometry
{
  namespace
  {
    using core::InputError;
    using dealii::Tensor;

    /** Mean thickness (twice the volume by the area) by extent, below which TetGen
     * may not come to an end: a plate of thickness 1e-3 has 7e-4. */
    constexpr double flattest = 5e-4;

    /** One closed part of the surface. */
    struct Part
    {
      unsigned int first  = 0; ///< its first triangle
      double       volume = 0., area = 0.;
      Point<3>     lower, upper;
    };

    std::vector<Part>
    measure_parts(const SurfaceMesh &surface, const SurfaceTopology &topology)
    {
      std::vector<Part> parts(topology.n_components);
      std::vector<bool> seen(topology.n_components, false);
      for (unsigned int t = 0; t < surface.triangles.size(); ++t)
        {
          Part &part = parts[topology.component[t]];
          if (!seen[topology.component[t]])
            {
              part.first = t;
              part.lower = part.upper     = surface.points[surface.triangles[t][0]];
              seen[topology.component[t]] = true;
            }
          // Seen from a point of the part itself, so that a part far from the
          // origin loses no digits.
          const Point<3>             &origin = surface.points[surface.triangles[part.first][0]];
          std::array<Tensor<1, 3>, 3> p;
          for (unsigned int k = 0; k < 3; ++k)
            {
              const Point<3> &x = surface.points[surface.triangles[t][k]];
              p[k]              = x - origin;
              for (unsigned int d = 0; d < 3; ++d)
                {
                  part.lower[d] = std::min(part.lower[d], x[d]);
                  part.upper[d] = std::max(part.upper[d], x[d]);
                }
            }
          part.volume += p[0] * dealii::cross_product_3d(p[1], p[2]) / 6.;
          part.area += dealii::cross_product_3d(p[1] - p[0], p[2] - p[0]).norm() / 2.;
        }
      return parts;
    }

    void
    check_thickness(const std::vector<Part> &parts,
                    const SurfaceMesh       &surface,
                    const std::string       &what)
    {
      for (const Part &part : parts)
        {
          const double thickness = 2. * std::abs(part.volume) / part.area;
          const double extent    = part.lower.distance(part.upper);
          if (thickness >= flattest * extent)
            continue;
          std::ostringstream message;
          message << what << ": the surface" << (parts.size() > 1 ? " part" : "") << " at "
                  << to_string(surface.points[surface.triangles[part.first][0]])
                  << " encloses nearly no volume: its mean thickness is " << thickness
                  << " for an extent of " << extent
                  << ". TetGen cannot mesh nearly flat bodies; make it thicker.";
          throw InputError(message.str());
        }
    }

    void
    check_intersections(const SurfaceMesh &surface, const std::string &what)
    {
      const auto pairs = self_intersections(surface);
      if (pairs.empty())
        return;
      std::ostringstream message;
      message << what << ": the surface intersects itself: " << pairs.size() << " pair"
              << (pairs.size() == 1 ? "" : "s") << " of triangles cross or touch; the first is "
              << pairs[0].first << " and " << pairs[0].second << ", with corners";
      for (const unsigned int t : {pairs[0].first, pairs[0].second})
        {
          message << (t == pairs[0].first ? " " : " and ");
          for (unsigned int k = 0; k < 3; ++k)
            message << (k > 0 ? ", " : "") << to_string(surface.points[surface.triangles[t][k]]);
        }
      message << ". Repair the surface, or coarsen it less if it was remeshed.";
      throw InputError(message.str());
    }

    SurfaceMesh
    extract(const SurfaceMesh &surface, const SurfaceTopology &topology, unsigned int part)
    {
      SurfaceMesh               result;
      std::vector<unsigned int> number(surface.points.size(), surface.points.size());
      for (unsigned int t = 0; t < surface.triangles.size(); ++t)
        if (topology.component[t] == part)
          {
            std::array<unsigned int, 3> triangle;
            for (unsigned int k = 0; k < 3; ++k)
              {
                unsigned int &v = number[surface.triangles[t][k]];
                if (v == surface.points.size())
                  {
                    v = result.points.size();
                    result.points.push_back(surface.points[surface.triangles[t][k]]);
                  }
                triangle[k] = v;
              }
            result.triangles.push_back(triangle);
          }
      return result;
    }

    void
    check_nesting(const SurfaceMesh       &surface,
                  const SurfaceTopology   &topology,
                  const std::vector<Part> &parts,
                  const std::string       &what)
    {
      for (unsigned int outer = 0; outer < parts.size(); ++outer)
        for (unsigned int inner = 0; inner < parts.size(); ++inner)
          {
            bool inside = inner != outer;
            for (unsigned int d = 0; d < 3; ++d)
              inside = inside && parts[inner].lower[d] > parts[outer].lower[d]
                       && parts[inner].upper[d] < parts[outer].upper[d];
            const Point<3> &point = surface.points[surface.triangles[parts[inner].first][0]];
            if (inside && encloses(extract(surface, topology, outer), point))
              throw InputError(what + ": the part of the surface at " + to_string(point)
                               + " lies inside another part. Surfaces with cavities or inclusions "
                                 "cannot be meshed: remove the inner part.");
          }
    }
  } // namespace

  CheckedSurface
  check_surface(const SurfaceMesh &surface, const std::string &what)
  {
    CheckedSurface result;
    result.mesh           = surface;
    result.dropped_points = check_triangles(result.mesh, what);
    const auto topology   = orient_consistently(result.mesh, what);
    const auto parts      = measure_parts(result.mesh, topology);
    check_thickness(parts, result.mesh, what);
    check_intersections(result.mesh, what);
    check_nesting(result.mesh, topology, parts, what);

    result.n_components = topology.n_components;
    for (const Part &part : parts)
      {
        result.volume += std::abs(part.volume);
        result.area += part.area;
      }
    for (unsigned int t = 0; t < result.mesh.triangles.size(); ++t)
      {
        const bool inward = parts[topology.component[t]].volume < 0.;
        if (inward)
          std::swap(result.mesh.triangles[t][1], result.mesh.triangles[t][2]);
        result.turned_triangles += inward != topology.turned[t];
      }
    return result;
  }
} // namespace tetradapt::geometry
