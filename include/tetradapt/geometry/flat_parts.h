// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_geometry_flat_parts_h
#define tetradapt_geometry_flat_parts_h

#include "tetradapt/geometry/surface_mesh.h"

#include <memory>

namespace tetradapt::geometry
{
  /** How much the shape of a surface hangs on one of its points. */
  enum class PointKind : unsigned char
  {
    corner, ///< the shape would change without it
    line,   ///< a straight outline passes through it
    flat,   ///< inside a flat part
    unused  ///< of no triangle
  };

  /**
   * The flat parts of a surface: triangles of one id that hang together in one plane
   * (normals within 1e-8 of that of the part's first triangle, so that slow curvature does
   * not add up). Each triangle of a curved part is a flat part of its own. With
   * them a surface can be triangulated again, coarser, without changing its shape.
   *
   * The surface need not be manifold: any number of triangles may share an edge, so that
   * walls between regions may be among them.
   */
  class FlatParts
  {
  public:
    /** Keeps a copy of @p surface. */
    explicit FlatParts(const SurfaceMesh &surface);
    ~FlatParts();

    /** Kinds of all points. */
    const std::vector<PointKind> &
    point_kinds() const;

    /**
     * The same surface between its corners and those points on lines and in flat parts
     * that @p keep (one flag a point) names; by CGAL's constrained Delaunay
     * triangulation.
     *
     * @return all points, with their numbers, and new triangles with the ids and the
     *         orientation of what they replace.
     * @throws core::NumericalError if rounding spoils it.
     */
    SurfaceMesh
    triangulate(const std::vector<bool> &keep) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace tetradapt::geometry

#endif
