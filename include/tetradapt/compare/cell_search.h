// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_cell_search_h
#define tetradapt_compare_cell_search_h

#include "tetradapt/mesh/nodal_field.h"

#include <functional>
#include <memory>

namespace tetradapt::compare
{
  using dealii::Point;

  /**
   * R-trees (Boost.Geometry, packed) of a mesh's cells and of its boundary
   * triangles: the slow but always successful part of PointLocator. Each tree is
   * built when it is first needed.
   */
  class CellSearch
  {
  public:
    /** What nearest() found. */
    struct Nearest
    {
      unsigned int      cell = 0;
      mesh::Barycentric barycentric{{0., 0., 0., 0.}}; ///< of the closest point, all >= 0
      double            distance = 0.;
    };

    /** Keeps a reference to @p mesh and @p neighbours (see mesh::cell_neighbors()). */
    CellSearch(const mesh::TetMesh                            &mesh,
               const std::vector<std::array<unsigned int, 4>> &neighbours);
    ~CellSearch();

    /** Numbers of all cells whose bounding boxes are not farther than
     * @p tolerance from @p p along any axis, in increasing order. */
    std::vector<unsigned int>
    candidates(const Point<3> &p, double tolerance) const;

    /** The boundary triangle closest to @p p, by true distance, as a point of its
     * cell. Meant for points outside the mesh, whose closest point lies on the
     * boundary. Of equally close ones, the lowest cell. */
    Nearest
    nearest_on_boundary(const Point<3> &p) const;

    /** The point of @p cell's surface closest to @p p. */
    Nearest
    nearest_on_cell(const Point<3> &p, unsigned int cell) const;

  private:
    struct Trees;
    const mesh::TetMesh                            &mesh;
    const std::vector<std::array<unsigned int, 4>> &neighbours;
    std::unique_ptr<Trees>                          trees;
  };
} // namespace tetradapt::compare

#endif
