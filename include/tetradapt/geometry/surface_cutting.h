// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_geometry_surface_cutting_h
#define tetradapt_geometry_surface_cutting_h

#include "tetradapt/core/condition.h"
#include "tetradapt/geometry/surface_mesh.h"

#include <functional>
#include <limits>
#include <string>

namespace tetradapt::geometry
{
  /** A condition whose border is to be cut into a surface. */
  struct SurfaceCut
  {
    std::string              name; ///< of whose condition it is, for reports
    core::Condition          condition;
    std::function<bool(int)> concerns; ///< whether it is asked for on triangles of an id
  };

  /** A surface with cuts. */
  struct CutSurface
  {
    /** The input's triangle that a triangle is, or nothing: it is new. */
    static constexpr unsigned int nothing = std::numeric_limits<unsigned int>::max();

    /** What a cut forces a mesh to resolve. */
    struct ShortEdge
    {
      std::string name; ///< of the SurfaceCut, or empty where several meet
      double      length     = 0.;
      double      local_size = 0.;
      Point<3>    middle;
    };

    SurfaceMesh               mesh; ///< the old points keep their numbers
    std::vector<unsigned int> origin;
    std::vector<ShortEdge>    short_edges;
  };

  /** A point, or a straight line between two points, that is to be part of a surface where it
   * touches it. */
  using SurfacePlace = std::vector<Point<3>>;

  /**
   * Triangulates a surface again where the borders of conditions run, so that each
   * triangle lies wholly where a condition holds or does not.
   *
   * Borders are looked for in each flat part (FlatParts) of the surface: of affine leaves
   * where their planes cross its outline, so exactly; of others by their sign on
   * a triangulation with a spacing of a hundredth of the body (spheres and cylinders: a
   * quarter of their radius, if that is less), so that a closed border that is smaller
   * may be missed. Only those pieces of a leaf's border are cut on which the whole
   * condition changes. A curved border becomes a polyline whose chords are at most
   * a hundredth of the local size off and turn by 30 degrees at most. Its inner corners lie
   * outside the curve by two thirds of that, so that the area enclosed is right up
   * to the fourth power of the chords' length. Where borders meet or cross, there is a point.
   *
   * Points nearer to each other than 1e-6 of the body's extent are made one: a border that
   * passes a point or an edge as near as that runs through it. The surface need not be
   * manifold. An edge is cut alike in all triangles that share it.
   *
   * A point of @p places on the surface becomes one of its points; a line becomes edges where
   * it lies in the surface, and points where it ends on it or goes through it. Such edges
   * are so short that no other point of their flat part lies in the sphere that has one of them as
   * its diameter: they are edges of the part's Delaunay triangulation, which TetGen
   * makes of facets in one plane.
   *
   * @param local_size wanted edge length at a point; the flat part's own longest edge counts,
   *        too.
   * @return the surface itself, where nothing is to be cut, else one with the same ids; flat
   *         parts without cuts keep their triangles.
   * @throws core::NumericalError if rounding spoils it; core::InputError as
   *         core::Condition does.
   */
  CutSurface
  cut_surface(const SurfaceMesh                             &surface,
              const std::vector<SurfaceCut>                 &cuts,
              const std::function<double(const Point<3> &)> &local_size,
              const std::vector<SurfacePlace>               &places = {});

  /** Points of a body as near as this to each other are one when it is cut. */
  double
  snap_distance(const SurfaceMesh &surface);
} // namespace tetradapt::geometry

#endif
