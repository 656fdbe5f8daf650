// SPDX-License-Identifier: AGPL-3.0-or-later
// The part of kept_places.h that puts places into a body before it is meshed.
#include "facet_triangles.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/surface_intersections.h"
#include "tetradapt/geometry/surface_topology.h"
#include "tetradapt/mesh/boundary_projection.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/mesh/kept_places.h"
#include "tetradapt/scene/mistakes.h"

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    using Complex = PiecewiseLinearComplex;

    /** The point of the triangle a, b, c that is nearest to @p p. */
    Point<3>
    nearest_in_triangle(const Point<3> &p, const Point<3> &a, const Point<3> &b, const Point<3> &c)
    {
      const auto on_edge = [&](const Point<3> &from, const Point<3> &to) {
        const Tensor<1, 3> edge = to - from;
        return from + std::clamp((p - from) * edge / edge.norm_square(), 0., 1.) * edge;
      };
      const Tensor<1, 3> normal = dealii::cross_product_3d(b - a, c - a);
      const Point<3>     foot   = p - ((p - a) * normal) / normal.norm_square() * normal;
      if (dealii::cross_product_3d(b - a, foot - a) * normal >= 0.
          && dealii::cross_product_3d(c - b, foot - b) * normal >= 0.
          && dealii::cross_product_3d(a - c, foot - c) * normal >= 0.)
        return foot;
      Point<3> nearest = on_edge(a, b);
      for (const Point<3> &other : {on_edge(b, c), on_edge(c, a)})
        if (other.distance(p) < nearest.distance(p))
          nearest = other;
      return nearest;
    }

    /** A body's boundary: what is near a point, and what inside. */
    class Boundary
    {
    public:
      Boundary(const Complex &plc, const BoundaryProjection *projection)
        : plc(plc), projection(projection), surface(triangulate(plc))
      {
        snap = geometry::snap_distance(surface);
      }

      /** The nearest point, and the patches of the triangles that have it. */
      struct Nearest
      {
        Point<3>               point;
        double                 distance = std::numeric_limits<double>::max();
        std::set<unsigned int> patches;
      };

      Nearest
      nearest(const Point<3> &p) const
      {
        Nearest result;
        for (std::size_t t = 0; t < surface.triangles.size(); ++t)
          {
            const auto    &v        = surface.triangles[t];
            const Point<3> foot     = nearest_in_triangle(p,
                                                      surface.points[v[0]],
                                                      surface.points[v[1]],
                                                      surface.points[v[2]]);
            const double   distance = foot.distance(p);
            if (distance < result.distance - .1 * snap)
              {
                result.point    = foot;
                result.distance = distance;
                result.patches.clear();
              }
            if (distance <= result.distance + .1 * snap)
              result.patches.insert(surface.ids[t]);
          }
        return result;
      }

      /** Of the curved surfaces of @p near: the distance of @p p from the nearest, and the point
       * there; none where all are flat. */
      std::optional<Nearest>
      on_true_surface(const Point<3> &p, const Nearest &near) const
      {
        std::optional<Nearest> result;
        for (const unsigned int patch : near.patches)
          if (projection != nullptr && projection->is_projected(plc.patches[patch]))
            {
              Nearest    here;
              const auto foot
                = projection->foot(plc.patches[patch], p, std::max(2. * near.distance, 1e4 * snap));
              if (foot)
                {
                  here.point    = *foot;
                  here.distance = foot->distance(p);
                }
              if (!result || here.distance < result->distance)
                result = here;
            }
        return result;
      }

      bool
      encloses(const Point<3> &p) const
      {
        return geometry::encloses(surface, p);
      }

      double snap = 0.;

    private:
      const Complex            &plc;
      const BoundaryProjection *projection;
      geometry::SurfaceMesh     surface;
    };

    [[noreturn]] void
    refuse_flat_place(const std::string                      &name,
                      const Point<3>                         &p,
                      const std::optional<Boundary::Nearest> &curved)
    {
      throw core::InputError(
        name + ": " + to_string(p)
        + " lies on a flat face of the first mesh, but the body's true surface (Mesh/Projection) "
          "is curved there"
        + (curved->distance < 1e300 ? "; its nearest point is " + geometry::to_string(curved->point)
                                    : "")
        + ". Give a point of the true surface.");
    }

    /** Where a point is to be put into the facets. */
    Point<3>
    place_of_point(const Boundary &boundary, const std::string &name, const Point<3> &p)
    {
      const auto near   = boundary.nearest(p);
      const auto curved = boundary.on_true_surface(p, near);
      if (curved && curved->distance <= boundary.snap)
        return near.point;
      if (near.distance <= boundary.snap)
        {
          if (curved)
            refuse_flat_place(name, p, curved);
          return near.point;
        }
      if (boundary.encloses(p))
        return p;
      throw core::InputError(name + ": " + to_string(p)
                             + " lies outside of the body, whose nearest point is "
                             + geometry::to_string(near.point) + ". Move it.");
    }

    /** Warns if a point or an end of a line lies inside, just below the surface. */
    void
    warn_of_depth(const Boundary  &boundary,
                  const KeptPlace &place,
                  const Point<3>  &p,
                  const core::Log &log)
    {
      const auto near = boundary.nearest(p);
      if (near.distance <= boundary.snap || near.distance >= 1e4 * boundary.snap)
        return;
      std::ostringstream text;
      text << place.name << (place.is_line() ? "/Line: " : "/Point: ") << geometry::to_string(p)
           << " lies inside the body, only " << near.distance
           << " from its surface, where the mesh becomes fine. If it is meant to lie on the "
              "surface, give the point "
           << to_string(near.point) << ".";
      log.warning(text.str());
    }

    /** A line's points must be where they are wanted before and after a projection. */
    void
    check_line(const Boundary &boundary, const KeptPlace &place)
    {
      constexpr unsigned int n_samples = 32;
      for (unsigned int i = 0; i <= n_samples; ++i)
        {
          const Point<3> p
            = place.ends[0] + double(i) / n_samples * (place.ends[1] - place.ends[0]);
          const auto near   = boundary.nearest(p);
          const auto curved = boundary.on_true_surface(p, near);
          if (near.distance > boundary.snap)
            {
              if (curved && curved->distance <= boundary.snap)
                throw core::InputError(
                  place.name + "/Line: " + geometry::to_string(p)
                  + " lies on the body's true surface (Mesh/Projection), but not on the first "
                    "mesh's: on curved walls lines must follow edges of the surface.");
              if (!boundary.encloses(p))
                throw core::InputError(place.name + "/Line: it leaves the body at "
                                       + geometry::to_string(p) + "; the body's nearest point is "
                                       + geometry::to_string(near.point)
                                       + ". Move it, or end it there.");
            }
          else if (curved && curved->distance > boundary.snap)
            refuse_flat_place(place.name + "/Line", p, curved);
        }
    }

    /** Adds the place where two lines cross inside as a point. */
    void
    add_crossing(const KeptPlace &one, const KeptPlace &other, double snap, Complex &plc)
    {
      const Tensor<1, 3> u = one.ends[1] - one.ends[0], v = other.ends[1] - other.ends[0];
      const Tensor<1, 3> w  = other.ends[0] - one.ends[0];
      const double       uu = u * u, uv = u * v, vv = v * v;
      const double       area = uu * vv - uv * uv;
      if (area <= 1e-12 * uu * vv)
        return; // parallel: what they share begins and ends at their ends
      const double s = ((w * u) * vv - (w * v) * uv) / area, t = (uv * s - w * v) / vv;
      if (s <= 0. || s >= 1. || t <= 0. || t >= 1.)
        return;
      const Point<3> p = one.ends[0] + s * u;
      if (p.distance(other.ends[0] + t * v) > snap)
        return;
      for (const Point<3> &known : plc.points)
        if (known.distance(p) <= 2. * snap)
          return;
      plc.points.push_back(p);
    }

    /** The number of the point at @p p, which is added if there is none. */
    unsigned int
    point_at(const Point<3> &p, const double snap, Complex &plc)
    {
      unsigned int nearest = plc.points.size();
      double       least   = 2. * snap;
      for (unsigned int i = 0; i < plc.points.size(); ++i)
        if (plc.points[i].distance(p) <= least)
          {
            least   = plc.points[i].distance(p);
            nearest = i;
          }
      if (nearest == plc.points.size())
        plc.points.push_back(p);
      return nearest;
    }

    /** The pieces of a line between the points that it passes, in order. */
    void
    add_segments(const KeptPlace                                       &place,
                 const Boundary                                        &boundary,
                 const std::set<std::pair<unsigned int, unsigned int>> &facet_edges,
                 Complex                                               &plc)
    {
      const Tensor<1, 3>                           way = place.ends[1] - place.ends[0];
      std::vector<std::pair<double, unsigned int>> passed;
      for (unsigned int i = 0; i < plc.points.size(); ++i)
        {
          const double t
            = std::clamp((plc.points[i] - place.ends[0]) * way / way.norm_square(), 0., 1.);
          if (plc.points[i].distance(place.ends[0] + t * way) <= 2. * boundary.snap)
            passed.emplace_back(t, i);
        }
      std::sort(passed.begin(), passed.end());
      for (std::size_t i = 1; i < passed.size(); ++i)
        {
          const std::array<unsigned int, 2> edge{{passed[i - 1].second, passed[i].second}};
          const Point<3>                    middle
            = plc.points[edge[0]] + .5 * (plc.points[edge[1]] - plc.points[edge[0]]);
          if (facet_edges.count(std::minmax(edge[0], edge[1])) == 0)
            {
              if (boundary.nearest(middle).distance <= boundary.snap)
                throw core::NumericalError(place.name
                                           + "/Line: it could not be cut into the surface at "
                                           + to_string(middle) + ". Move it slightly.");
              if (!boundary.encloses(middle))
                throw core::InputError(place.name + "/Line: it leaves the body between "
                                       + geometry::to_string(plc.points[edge[0]]) + " and "
                                       + geometry::to_string(plc.points[edge[1]]) + ". Move it.");
            }
          plc.segments.push_back(edge);
        }
    }

    std::set<std::pair<unsigned int, unsigned int>>
    edges_of_facets(const Complex &plc)
    {
      std::set<std::pair<unsigned int, unsigned int>> edges;
      for (const auto &facet : plc.facets)
        for (std::size_t i = 0; i < facet.vertices.size(); ++i)
          edges.insert(
            std::minmax(facet.vertices[i], facet.vertices[(i + 1) % facet.vertices.size()]));
      return edges;
    }
  } // namespace

  PiecewiseLinearComplex
  with_kept_places(const Complex                &plc,
                   const std::vector<KeptPlace> &places,
                   const BoundaryProjection     *projection,
                   const core::Log              &log)
  {
    if (places.empty())
      return plc;
    const Boundary                      boundary(plc, projection);
    std::vector<KeptPlace>              kept = places;
    std::vector<geometry::SurfacePlace> wanted;
    scene::Mistakes                     mistakes;
    for (KeptPlace &place : kept)
      mistakes.attempt([&]() {
        if (place.is_line())
          check_line(boundary, place);
        else
          place.ends.front() = place_of_point(boundary, place.name + "/Point", place.ends.front());
        for (const Point<3> &end : place.ends)
          warn_of_depth(boundary, place, end, log);
        wanted.push_back(place.ends);
      });
    mistakes.throw_together();
    const FacetTriangles triangles(plc);
    const auto           none = [](const Point<3> &) { return 0.; };
    Complex              result
      = with_cut_facets(plc, triangles, geometry::cut_surface(triangles.surface, {}, none, wanted));
    const auto facet_edges = edges_of_facets(result);
    for (std::size_t i = 0; i < kept.size(); ++i)
      for (std::size_t e = 0; e < kept[i].ends.size(); ++e)
        {
          Point<3>          &end    = kept[i].ends[e];
          const Point<3>    &given  = places[i].ends[e];
          const unsigned int number = point_at(end, boundary.snap, result);
          // From the facet to the true surface.
          if (end.distance(given) > boundary.snap)
            result.points[number] = given;
          end = result.points[number];
        }
    for (std::size_t i = 0; i < kept.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (kept[i].is_line() && kept[j].is_line())
          add_crossing(kept[i], kept[j], boundary.snap, result);
    for (const KeptPlace &place : kept)
      if (place.is_line())
        add_segments(place, boundary, facet_edges, result);
    result.kept = kept;
    return result;
  }
} // namespace tetradapt::mesh
