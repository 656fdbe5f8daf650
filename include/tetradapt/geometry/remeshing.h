// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_geometry_remeshing_h
#define tetradapt_geometry_remeshing_h

#include "tetradapt/geometry/checked_surface.h"

#include <string>

namespace tetradapt::geometry
{
  /** What remesh() returns. */
  struct RemeshedSurface
  {
    CheckedSurface surface;
    /** The edge length used: the wanted one, or up to a fifth less where that one
     * led to intersections that could not be repaired. */
    double edge_length = 0.;
    /** Relative change of the enclosed volume, with its sign. */
    double volume_change = 0.;
    /** Pairs of triangles that intersected after the remeshing and were replaced. */
    unsigned int repaired_intersections = 0;
    /** Whether sharp edges were kept; false where that led to intersections that
     * could not be repaired. */
    bool kept_features = true;
  };

  /**
   * Replaces a closed surface's triangles by nearly equilateral ones with edges of
   * about @p edge_length, by CGAL's isotropic remeshing (M. Botsch, L. Kobbelt,
   * SGP 2004; three rounds), projected back on the given surface.
   *
   * Edges where triangles meet at more than @p feature_angle degrees (180: none)
   * and edges between different ids are kept as lines, cut into pieces of about
   * @p edge_length; points where such lines end, branch or bend by more than the
   * feature angle stay where they are. Sharp edges that together extend over less
   * than four times @p edge_length are taken for noise: kept, they would crumple
   * the surface. Triangles keep the id of the part that the lines surround.
   *
   * @param surface is checked by check_surface() first, as is the result.
   * @param what names the surface in messages.
   * @throws InputError if the surface or a parameter cannot be used, or if the
   *         edges are too long for the surface: the result intersects itself
   *         beyond repair, or its volume changes by more than a tenth.
   */
  RemeshedSurface
  remesh(const SurfaceMesh &surface,
         double             edge_length,
         double             feature_angle,
         const std::string &what = "the surface");
} // namespace tetradapt::geometry

#endif
