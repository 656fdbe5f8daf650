// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_geometry_flat_part_search_h
#define tetradapt_source_geometry_flat_part_search_h

#include "tetradapt/geometry/surface_mesh.h"

#include <tuple>

namespace tetradapt::geometry
{
  using dealii::Tensor;

  /** Sine of the angle up to which planes and lines are taken for one: above the
   * rounding of points that were inserted, below any curvature that is meant. */
  constexpr double flat_sine = 1e-8;

  /** An edge of a triangle. */
  struct OutlineSide
  {
    unsigned int first, second; ///< smaller point number first
    unsigned int triangle;

    bool
    operator<(const OutlineSide &other) const
    {
      return std::tie(first, second, triangle)
             < std::tie(other.first, other.second, other.triangle);
    }
    bool
    same_edge(const OutlineSide &other) const
    {
      return first == other.first && second == other.second;
    }
  };

  /** Which triangles lie in one plane, and the edges between such parts. */
  struct FlatPartList
  {
    std::vector<unsigned int>              of_triangle;
    std::vector<std::vector<unsigned int>> triangles; ///< of each part
    std::vector<Tensor<1, 3>>              normals;   ///< of each part
    std::vector<std::vector<OutlineSide>>  outlines;  ///< of each part; triangle: any of it
    /** Ends of outline edges: per point its neighbours along outlines, each once. */
    std::vector<std::vector<unsigned int>> outline_neighbours;
  };

  /** The flat parts of a surface as FlatParts describes them. */
  FlatPartList
  find_flat_parts(const SurfaceMesh &surface);
} // namespace tetradapt::geometry

#endif
