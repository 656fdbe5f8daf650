// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_plc_h
#define tetradapt_mesh_plc_h

#include "tetradapt/geometry/surface_mesh.h"
#include "tetradapt/mesh/tet_mesh.h"

#include <deal.II/base/types.h>

namespace tetradapt::mesh
{
  /**
   * What TetGen makes a volume mesh from: a closed boundary of flat facets, facets
   * between two regions, and a point inside every region that shall have an id.
   */
  struct PiecewiseLinearComplex
  {
    /** The "patch" of a facet between two regions. */
    static constexpr unsigned int inner = dealii::numbers::invalid_unsigned_int;

    /** A flat convex polygon. */
    struct Facet
    {
      std::vector<unsigned int> vertices;  ///< point numbers in cyclic order
      unsigned int              patch = 0; ///< index into patches, or inner
    };

    /** A part of the volume and its id. */
    struct Region
    {
      Point<3> seed; ///< a point strictly inside
      int      id = 0;
    };

    std::string           name; ///< for messages: "the box", "femur.off"
    std::vector<Point<3>> points;
    std::vector<Facet>    facets;
    std::vector<Patch>    patches;
    std::vector<Region>   regions; ///< empty: everything is region 0
    /** Edges that a mesh must have, or more of them along these: point numbers. */
    std::vector<std::array<unsigned int, 2>> segments;
    std::vector<KeptPlace>                   kept; ///< what points and segments are for
    /** Relative change of the volume that is taken for rounding: facets within 0.01
     * degree of one plane are meshed as one. */
    double volume_tolerance = 1e-6;
  };

  /**
   * The boundary of an axis-parallel box: six rectangles with the boundary ids 1
   * to 6 and the names x-min, x-max, y-min, y-max, z-min, z-max.
   *
   * @throws InputError if a coordinate is not finite, @p upper is not above @p
   *         lower in every direction, or one side is more than 1000 times shorter
   *         than another: TetGen does not come to an end on nearly flat boxes.
   */
  PiecewiseLinearComplex
  box_complex(const Point<3> &lower, const Point<3> &upper);

  /**
   * The triangles of a surface as facets, with one patch per boundary id of the
   * surface, in increasing order of the ids.
   *
   * @param name names the surface in messages.
   */
  PiecewiseLinearComplex
  surface_complex(const geometry::SurfaceMesh &surface, const std::string &name);

  /** The six sides of a box as patches: boundary ids 1 to 6, named x-min, x-max,
   * y-min, y-max, z-min, z-max. */
  std::vector<Patch>
  box_patches();

  /** The facets of the boundary cut into triangles, each with its facet's patch as
   * id. Inner facets are left out. */
  geometry::SurfaceMesh
  triangulate(const PiecewiseLinearComplex &plc);
} // namespace tetradapt::mesh

#endif
