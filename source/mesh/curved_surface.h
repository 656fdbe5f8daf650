// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_curved_surface_h
#define tetradapt_mesh_curved_surface_h

#include "tetradapt/core/expression.h"
#include "tetradapt/geometry/nearest_surface.h"
#include "tetradapt/mesh/true_surface.h"

#include <functional>
#include <optional>

namespace tetradapt::mesh
{
  using dealii::Point;
  using dealii::Tensor;

  /** A surface near a point, replaced by a plane. */
  struct LocalPlane
  {
    double       distance = 0.; ///< of the point from it, with a sign
    Tensor<1, 3> normal;        ///< of length 1; zero if there is none
  };

  /** The plane that a function's zero set looks like from @p point, by differences over a part
   * of @p length. */
  LocalPlane
  plane_of_zero_set(const std::function<double(const Point<3> &)> &function,
                    const Point<3>                                &point,
                    double                                         length);

  /** A part of a body's true boundary. */
  class CurvedSurface
  {
  public:
    virtual ~CurvedSurface() = default;

    /** The selection that patches on this surface carry. */
    virtual std::string
    name() const = 0;

    /** The surface as seen from @p point; @p length is that of an edge there. */
    virtual LocalPlane
    plane_near(const Point<3> &point, double length) const = 0;

    /** The foot of @p point, which is within @p length of the surface, and the normal there, of
     * either sign; none if it is not found. By default from plane_near(), with Newton's
     * method. */
    virtual std::optional<SurfacePoint>
    foot(const Point<3> &point, double length) const;

    /** The nearest point on a sharp edge; none if there is none. */
    virtual std::optional<Point<3>>
    nearest_on_crease(const Point<3> &) const
    {
      return std::nullopt;
    }
  };

  /** A fine triangulated surface. */
  class TriangulatedSurface : public CurvedSurface
  {
  public:
    TriangulatedSurface(const geometry::SurfaceMesh &surface, double crease_angle)
      : nearest(surface, crease_angle)
    {
    }

    std::string
    name() const override
    {
      return "Mesh/Projection";
    }
    LocalPlane
    plane_near(const Point<3> &point, double length) const override;
    std::optional<SurfacePoint>
    foot(const Point<3> &point, double length) const override;
    std::optional<Point<3>>
    nearest_on_crease(const Point<3> &point) const override
    {
      return nearest.nearest_on_crease(point);
    }

  private:
    geometry::NearestSurface nearest;
  };

  /** Where a function vanishes. */
  class ZeroSet : public CurvedSurface
  {
  public:
    /** @param number from 1, in Mesh/Projection functions. */
    ZeroSet(const std::string &function, unsigned int number);

    std::string
    name() const override
    {
      return place;
    }
    LocalPlane
    plane_near(const Point<3> &point, double length) const override;

  private:
    std::string      place;
    core::Expression function;
  };

  /** The surfaces that a scene projects the boundary on, none for Projection = none.
   * @throws core::InputError if a surface cannot be read or a function does not parse. */
  std::vector<std::unique_ptr<CurvedSurface>>
  curved_surfaces(const scene::MeshParameters &parameters);

  /**
   * The point on all of @p surfaces, and in all of @p planes (each by a normal of length
   * 1; they pass through @p start), that Newton's method finds from @p start with
   * the smallest steps.
   *
   * @param length the scale of lengths there.
   * @return nothing if it does not converge within the distance @p length.
   */
  std::optional<Point<3>>
  find_foot(const Point<3>                           &start,
            const std::vector<const CurvedSurface *> &surfaces,
            const std::vector<Tensor<1, 3>>          &planes,
            double                                    length);
} // namespace tetradapt::mesh

#endif
