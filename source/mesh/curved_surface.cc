// SPDX-License-Identifier: AGPL-3.0-or-later
#include "curved_surface.h"

#include "tetradapt/geometry/checked_surface.h"
#include "tetradapt/geometry/surface_io.h"

namespace tetradapt::mesh
{
  namespace
  {
    constexpr unsigned int most_steps = 30;

    /** Relative to the length of an edge: when a point lies on a surface, ... */
    constexpr double on_surface = 1e-12;
    /** ... when it does at the end of an iteration that rounding stopped, ... */
    constexpr double near_surface = 1e-7;
    /** ... and the step of numerical differentiation. */
    constexpr double difference = 1e-4;

    /** Sine of the angle under which two surfaces are taken for one. */
    constexpr double parallel = 1e-3;

    /** The surfaces' planes at a point, one made perpendicular to the other. */
    class Constraints
    {
    public:
      /** Adds a plane unless its normal is spanned by those that are there. */
      void
      add(const LocalPlane &plane)
      {
        // The step found so far already changes the distance from this plane.
        Tensor<1, 3> normal   = plane.normal;
        double       distance = plane.distance + step * plane.normal;
        for (unsigned int i = 0; i < n; ++i)
          normal -= (normal * directions[i]) * directions[i];
        const double size = normal.norm();
        if (size < parallel || n == 3)
          return;
        directions[n++] = normal / size;
        step -= distance / size * directions[n - 1];
      }

      Tensor<1, 3> step;

    private:
      std::array<Tensor<1, 3>, 3> directions;
      unsigned int                n = 0;
    };
  } // namespace

  LocalPlane
  TriangulatedSurface::plane_near(const Point<3> &point, double length) const
  {
    const auto         foot = nearest.nearest(point);
    const Tensor<1, 3> way  = point - foot.point;
    const double       size = way.norm();
    if (size <= on_surface * length)
      return {0., foot.normal};
    return {size, way / size};
  }

  std::optional<SurfacePoint>
  TriangulatedSurface::foot(const Point<3> &point, double length) const
  {
    const auto foot = nearest.nearest(point);
    if (foot.point.distance(point) > length)
      return std::nullopt;
    return SurfacePoint{foot.point, foot.normal};
  }

  ZeroSet::ZeroSet(const std::string &function, unsigned int number)
    : place("Mesh/Projection functions " + std::to_string(number)),
      function(function, "Mesh/Projection functions, number " + std::to_string(number))
  {
  }

  LocalPlane
  ZeroSet::plane_near(const Point<3> &point, double length) const
  {
    return plane_of_zero_set([this](const Point<3> &p) { return function(p); }, point, length);
  }

  LocalPlane
  plane_of_zero_set(const std::function<double(const Point<3> &)> &function,
                    const Point<3>                                &point,
                    const double                                   length)
  {
    const double value = function(point);
    Tensor<1, 3> gradient;
    for (unsigned int d = 0; d < 3; ++d)
      {
        Point<3> before = point, after = point;
        before[d] -= difference * length;
        after[d] += difference * length;
        gradient[d] = (function(after) - function(before)) / (after[d] - before[d]);
      }
    const double size = gradient.norm();
    if (!(size > 0.))
      return {};
    return {value / size, gradient / size};
  }

  std::optional<SurfacePoint>
  CurvedSurface::foot(const Point<3> &point, const double length) const
  {
    const auto found = find_foot(point, {this}, {}, length);
    if (!found)
      return std::nullopt;
    return SurfacePoint{*found, plane_near(*found, length).normal};
  }

  std::vector<std::unique_ptr<CurvedSurface>>
  curved_surfaces(const scene::MeshParameters &parameters)
  {
    using Projection = scene::MeshParameters::Projection;
    std::vector<std::unique_ptr<CurvedSurface>> surfaces;
    if (parameters.projection == Projection::surface)
      {
        const bool own  = parameters.projection_file.empty();
        const auto file = own ? parameters.files.front() : parameters.projection_file;
        surfaces.push_back(std::make_unique<TriangulatedSurface>(
          geometry::check_surface(geometry::read_surface(file), file).mesh,
          parameters.feature_angle));
      }
    else if (parameters.projection == Projection::expression)
      for (unsigned int i = 0; i < parameters.projection_functions.size(); ++i)
        surfaces.push_back(std::make_unique<ZeroSet>(parameters.projection_functions[i], i + 1));
    return surfaces;
  }

  std::optional<Point<3>>
  find_foot(const Point<3>                           &start,
            const std::vector<const CurvedSurface *> &surfaces,
            const std::vector<Tensor<1, 3>>          &planes,
            double                                    length)
  {
    Point<3> point = start;
    double   last  = length;
    for (unsigned int i = 0; i < most_steps; ++i)
      {
        Constraints constraints;
        double      farthest = 0.;
        // Planes first: where there are too many conditions, flat faces stay flat.
        for (const Tensor<1, 3> &normal : planes)
          constraints.add({(point - start) * normal, normal});
        for (const CurvedSurface *surface : surfaces)
          {
            const LocalPlane plane = surface->plane_near(point, length);
            constraints.add(plane);
            farthest
              = std::max(farthest,
                         plane.normal.norm_square() > 0. ? std::abs(plane.distance) : length);
          }
        // Rounding ends what converges.
        if (farthest <= on_surface * length
            || (farthest <= near_surface * length && farthest >= last))
          return point;
        last = farthest;
        point += constraints.step;
        if (!(point.distance(start) <= length))
          return std::nullopt;
      }
    return std::nullopt;
  }
} // namespace tetradapt::mesh
