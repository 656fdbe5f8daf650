// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_saved_sizes_h
#define tetradapt_adapt_saved_sizes_h

#include "tetradapt/compare/point_locator.h"
#include "tetradapt/mesh/size_function.h"

#include <string>

namespace tetradapt::adapt
{
  /**
   * The edge lengths that an earlier run ended with, as a function for another body:
   * points of that body's bounding box are mapped linearly, direction by direction, to the
   * saved mesh's, where the length is linear in each cell (outside: that of the nearest
   * point), and it is multiplied by the geometric mean of the three stretches.
   */
  class SavedSizes
  {
  public:
    /** Reads what report::SizeFieldFile wrote. @throws core::InputError naming the file if
     * it cannot be read or has no positive point array "size". */
    explicit SavedSizes(const std::string &file);

    unsigned int
    n_cells() const
    {
      return locator->mesh().n_cells();
    }

    /** The lengths for a body in a box. The function keeps a reference to this. */
    mesh::SizeFunction
    for_box(const mesh::Point<3> &lower, const mesh::Point<3> &upper) const;

  private:
    std::unique_ptr<compare::PointLocator> locator;
    std::vector<double>                    sizes; ///< one a point
  };

  /**
   * A mesh as fine as saved sizes want it, refined from @p start in small steps.
   *
   * @param change see mesh::mesh_with_size().
   */
  mesh::TetMesh
  mesh_with_saved_sizes(const mesh::Tetgen     &tetgen,
                        const mesh::TetMesh    &start,
                        const SavedSizes       &sizes,
                        const mesh::MeshChange &change,
                        mesh::SizeReport       *report);
} // namespace tetradapt::adapt

#endif
