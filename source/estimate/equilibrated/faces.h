// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_faces_h
#define tetradapt_estimate_equilibrated_faces_h

#include "tetradapt/mesh/face_table.h"

namespace tetradapt::estimate
{
  /**
   * The faces of a mesh, numbered, and how the faces of the cells lie on them. A
   * face's corners and its normal are those of the face of its first cell; the
   * second cell sees them in another order and the normal reversed.
   */
  struct CellFaces
  {
    /** For a finalized mesh. */
    explicit CellFaces(const mesh::TetMesh &mesh);

    /** A face as a cell sees it. */
    struct Side
    {
      unsigned int                 face;   ///< its number
      std::array<unsigned char, 3> corner; ///< place of each corner in the face
      bool                         second; ///< the normal points into the cell

      /** Place in the face of function @p s on the cell's face: l_0, l_1, l_2, or
       * those of its edges (0,1), (1,2), (2,0). */
      unsigned int
      function(const unsigned int s) const
      {
        // Edge s lies opposite corner s + 2.
        return s < 3 ? corner[s] : 3 + (corner[(s + 2) % 3] + 1) % 3;
      }
    };

    unsigned int                     n_faces = 0;
    std::vector<std::array<Side, 4>> sides;    ///< four a cell
    std::vector<unsigned int>        boundary; ///< a face's number in mesh.faces, or invalid
  };
} // namespace tetradapt::estimate

#endif
