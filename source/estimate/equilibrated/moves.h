// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_moves_h
#define tetradapt_estimate_equilibrated_moves_h

#include "faces.h"
#include "loads.h"

#include "tetradapt/mesh/edges.h"

namespace tetradapt::estimate
{
  /**
   * The ways of changing the tractions on the faces of a mesh so that every cell
   * stays in equilibrium. On one face alone: tractions without force and moment.
   * On the faces around an edge: a force that goes round, in at one face of each
   * cell and out at the other, as a multiple of the barycentric coordinate of an
   * end of the edge. Where the edge is on the boundary, the force comes from one
   * support and goes into another. Together, these span all changes.
   */
  struct TractionMoves
  {
    /** How a ring passes a cell. The two numbers of an array belong to the ends of
     * the edge, smaller point number first. */
    struct Turn
    {
      unsigned int                 cell;
      std::array<unsigned char, 2> face;      ///< of the cell: in, out
      std::array<unsigned char, 2> corner[2]; ///< in, out: the ends' places on the face
    };

    /** @p edges of the mesh. */
    TractionMoves(const mesh::TetMesh         &mesh,
                  const mesh::EdgeTable       &edges,
                  const CellFaces             &faces,
                  const std::vector<FaceLoad> &loads);

    /** Bits of the components that may change on a face; 0 where a traction is given. */
    std::vector<unsigned char> face_components;

    unsigned int
    n_rings() const
    {
      return ring_components.size();
    }
    std::vector<unsigned char> ring_components;
    std::vector<unsigned int>  ring_begin; ///< in turns; one more entry
    std::vector<Turn>          turns;
    /** Rings by the cell of their first turn: first number a cell, one more entry. */
    std::vector<unsigned int> cell_begin;
    std::vector<unsigned int> cell_rings;

  private:
    void
    walk(unsigned int           edge,
         const mesh::TetMesh   &mesh,
         const mesh::EdgeTable &edges,
         const CellFaces       &faces);
    void
    sort_rings(unsigned int n_cells);

    /** A cell at the edge being walked round: its two faces there. */
    struct Leaf
    {
      unsigned int cell, edge;
      unsigned int faces[2]; ///< numbers
      bool         done;
    };
    std::vector<Leaf> leaves;
  };
} // namespace tetradapt::estimate

#endif
