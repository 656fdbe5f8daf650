// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_point_locator_h
#define tetradapt_compare_point_locator_h

#include "tetradapt/mesh/nodal_field.h"

#include <memory>

namespace tetradapt::compare
{
  using dealii::Point;
  using dealii::Tensor;

  /** Where a point lies in a mesh. */
  struct Location
  {
    unsigned int      cell = 0;
    mesh::Barycentric barycentric{{0., 0., 0., 0.}}; ///< all >= 0: outside points are projected
    double            distance = 0.; ///< to the cell; 0 inside (up to the tolerance)
  };

  /**
   * Finds the tetrahedron that holds a point: a walk from the last cell found
   * across faces, else an R-tree of bounding boxes (Boost.Geometry), barycentric
   * inversion with a relative tolerance, and for points outside the mesh the
   * nearest cell with its distance.
   */
  class PointLocator
  {
  public:
    explicit PointLocator(std::shared_ptr<const mesh::TetMesh> mesh);
    ~PointLocator();

    /** Where @p point lies. @p hint is a cell near it, if one is known. */
    Location
    locate(const Point<3> &point, unsigned int hint = dealii::numbers::invalid_unsigned_int) const;

    /** All points, each search starting where the one before ended. */
    std::vector<Location>
    locate(const std::vector<Point<3>> &points) const;

    const mesh::TetMesh &
    mesh() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace tetradapt::compare

#endif
