// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_geometry_triangle_conflicts_h
#define tetradapt_geometry_triangle_conflicts_h

#include "tetradapt/geometry/surface_mesh.h"

namespace tetradapt::geometry
{
  /** Two triangles of a body's boundary that should not be where they are. */
  struct TriangleConflict
  {
    enum class Kind
    {
      crossing,  ///< they pass through each other, or share area and look the same way: the
                 ///< body penetrates itself
      interface, ///< they touch: two sides of one interface that are cut differently, so
                 ///< that they are not joined
      gap        ///< they look at each other across a gap far smaller than they are
    };
    Kind         kind;
    unsigned int first, second; ///< numbers of the triangles, first < second
    Point<3>     place;         ///< a point of the first triangle near the second
    double       distance;      ///< width of a gap; 0 for the other kinds
  };

  /**
   * Looks at all pairs of triangles of the boundary of one or more bodies. Triangles may
   * share points and edges (any number of them an edge); they may not meet anywhere else.
   * Tests for crossing are exact (CGAL's predicates); what touches to 1e-6 of its size
   * counts as lying on each other.
   *
   * @param boundary triangles, counter-clockwise seen from outside, without repetitions.
   * @param parts the number of the connected part that each triangle belongs to: gaps
   *        are looked for between different parts.
   * @param gap gaps narrower than this fraction of the shorter of the two triangles'
   *        longest edges are listed.
   * @return the conflicts of the kind that comes first in the enumeration and occurs, in
   *         increasing order of the triangles.
   */
  std::vector<TriangleConflict>
  triangle_conflicts(const SurfaceMesh               &boundary,
                     const std::vector<unsigned int> &parts,
                     double                           gap);
} // namespace tetradapt::geometry

#endif
