// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_finalize_h
#define tetradapt_mesh_finalize_h

#include "tetradapt/mesh/face_table.h"

#include <string>

namespace tetradapt::mesh
{
  /** What finalize() had to change. */
  struct FinalizeReport
  {
    unsigned int removed_points         = 0; ///< named by no cell
    unsigned int flipped_cells          = 0; ///< had negative volume
    unsigned int added_faces            = 0; ///< boundary triangles that were not listed
    unsigned int dropped_interior_faces = 0; ///< listed, but between two cells
    unsigned int dropped_repeated_faces = 0; ///< listed more than once, always in one patch
  };

  /**
   * Checks a mesh that came from outside and brings it into the state that
   * TetMesh promises. Cells and points keep their order. In this order:
   * sizes and point numbers are checked; points that no cell names are removed;
   * coordinates must be finite and no two points the same; cells of negative
   * volume are turned (their last two vertices change places), flat ones are
   * refused (volume below 1e-12 of the longest edge's cube, or below what the
   * coordinates' rounding allows to see); no triangle may belong to more than two
   * cells, nor two cells lie on the same side of one; every listed triangle
   * must be a face of a cell. Listed triangles between two cells are dropped, as
   * are repetitions; boundary triangles that are not listed are added in a
   * patch without name and with boundary id 0, made if there is none. All end
   * up counter-clockwise seen from outside. An empty list of regions is filled
   * with zeros.
   *
   * @param what names the mesh at the beginning of messages: a file, for example.
   * @throws core::InputError naming the cell (counted from 0), the points and
   *         their coordinates; the mesh is then in no useful state.
   */
  FinalizeReport
  finalize(TetMesh &mesh, const std::string &what);

  /** The last step of finalize(): everything about triangles. Cells must be
   * positive. */
  void
  complete_boundary(TetMesh &mesh, const std::string &what, FinalizeReport &report);

  /** "(x, y, z)" with as many digits as tell two different points apart. */
  std::string
  to_string(const Point<3> &point);
} // namespace tetradapt::mesh

#endif
