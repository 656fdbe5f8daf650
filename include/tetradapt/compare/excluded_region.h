// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_excluded_region_h
#define tetradapt_compare_excluded_region_h

#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::compare
{
  using dealii::Point;

  /**
   * The part of a body that errors and estimates leave out: balls around points and tubes with
   * round ends around lines where a force acts on one vertex, or where a support holds one
   * vertex or a line of edges. The energy of the solution there is infinite, and that of a
   * discrete one grows without limit as the mesh is refined; outside of any ball around
   * it, discrete solutions converge.
   *
   * A cell belongs to the region if its centroid does. So a cell that is larger than the ball
   * counts until refinement has made it smaller. Norms that errors are compared with leave
   * out the same.
   */
  class ExcludedRegion
  {
  public:
    /** A ball (both ends are the same), or a tube with round ends. */
    struct Part
    {
      std::string             name; ///< of the support or load, "Loads/tip"
      std::array<Point<3>, 2> ends;
      double                  radius   = 0.; ///< 0: nothing is left out
      bool                    is_force = false;

      bool
      contains(const Point<3> &point) const;
      /** "within 0.2 of (4, 0, 0)", "within 0.1 of the line from (0, 0, 0) to (1, 0, 0)". */
      std::string
      text() const;
    };

    /** Nothing. */
    ExcludedRegion() = default;

    /** What the scene's points and lines leave out. @p mesh, one of its meshes, has
     * them and the body's size. */
    ExcludedRegion(const scene::Scene &scene, const mesh::TetMesh &mesh);

    /** Whether nothing is left out. */
    bool
    empty() const;

    /** All points and lines, also those around which nothing is left out. */
    const std::vector<Part> &
    all_parts() const
    {
      return parts;
    }

    bool
    contains(const Point<3> &point) const;

    /** One flag a cell: it is left out. All false for an empty region.
     * @throws core::InputError if every cell is. */
    std::vector<bool>
    cells(const mesh::TetMesh &mesh) const;

    /** Sets the values of cells that are left out to zero. */
    void
    clear(const mesh::TetMesh &mesh, std::vector<double> &cell_values) const;

    /**
     * Gives the cells that are left out indicators of a constant density, that of the
     * cells that touch the same part from outside: the squares add up to as much a volume.
     * Sizes that follow the indicators then are inside as they are around the part. With zero
     * they would be as large as gradation allows, which spoils the solution outside; with
     * the estimator's own values refinement would never end at the point.
     */
    void
    continue_into(const mesh::TetMesh &mesh, std::vector<double> &indicators) const;

  private:
    /** The part that a cell belongs to, or the number of parts. */
    unsigned int
    part_of(const mesh::TetMesh &mesh, unsigned int cell) const;

    std::vector<Part> parts;
  };
} // namespace tetradapt::compare

#endif
