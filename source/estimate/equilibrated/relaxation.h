// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_relaxation_h
#define tetradapt_estimate_equilibrated_relaxation_h

#include "cells.h"
#include "moves.h"

namespace tetradapt::estimate
{
  /**
   * Lowers the energy of the equilibrated stress in some cells by changing the
   * tractions between them, with the moves that leave all other cells as they are: a
   * block Gauss-Seidel method (one block a face, one a ring), each sweep followed
   * by the best combination of its change and that of the sweep before.
   */
  class TractionRelaxation
  {
  public:
    /** Most cells that relax() should be given: it needs 22 kB a cell. */
    static constexpr unsigned int most_cells = 20000;

    /** The arguments must outlive this object. */
    TractionRelaxation(const mesh::TetMesh &mesh,
                       const CellFaces     &faces,
                       const TractionMoves &moves,
                       const CellStates    &states);

    /** Sweeps end when one lowers the energy (a square) by less than this part of it. */
    static constexpr double       least_fall  = .04;
    static constexpr unsigned int most_sweeps = 40;

    /** Changes @p moments (see FaceTractions) of the faces of @p cells where the
     * moves are known to concern these only. */
    void
    relax(const std::vector<unsigned int> &cells, std::vector<double> &moments);

    /** Per cell and face: six functions of three components, in the order and with
     * the sign of the numbered face. */
    static constexpr unsigned int n = 72;

    struct FaceMove
    {
      unsigned int  owner;    ///< the cell after which it comes
      unsigned int  face;     ///< local number
      unsigned int  cells[2]; ///< 4 * local cell + its face; or none
      unsigned char components;
      unsigned char size;
      double        edges[9];   ///< vectors between the corners: 0 to 1, 1 to 2, 2 to 0
      double        factor[78]; ///< Cholesky's, diagonal inverted
    };
    struct RingMove
    {
      unsigned int  owner;      ///< the cell after which it comes
      unsigned int  begin, end; ///< in turns
      unsigned char components[6];
      unsigned char size;
      double        factor[21];
    };
    struct RingTurn
    {
      unsigned int  cell;
      unsigned int  face[2];  ///< local numbers
      unsigned char first[2]; ///< 18 * face of the cell
      unsigned char at[2][2]; ///< in, out: 3 * place of each end
      double        sign[2];
    };
    /** What the sweeps work on. */
    struct State
    {
      unsigned int          n_cells;
      std::vector<FaceMove> face_moves;
      std::vector<RingMove> ring_moves;
      std::vector<RingTurn> turns;
      std::vector<float>    flexibility; ///< n x n a cell
      std::vector<double>   gradient;    ///< n a cell; half the energy's
      std::vector<double>   change;      ///< of the moments, 18 a face
    };

  private:
    void
    number(const std::vector<unsigned int> &cells);
    double
    differentiate(const std::vector<unsigned int> &cells, const std::vector<double> &moments);
    void
    scatter(const std::vector<unsigned int> &cells,
            unsigned int                     c,
            unsigned int                     used,
            const CellBatch                 &batch);
    void
    collect_faces(const std::vector<unsigned int> &cells);
    void
    collect_rings(const std::vector<unsigned int> &cells);
    double
    accelerate(bool first);

    const mesh::TetMesh      &mesh;
    const CellFaces          &faces;
    const TractionMoves      &moves;
    const CellStates         &states;
    std::vector<unsigned int> local_cell, local_face; ///< by number; or none
    std::vector<unsigned int> face_number;            ///< of a local face
    std::vector<unsigned int> cell_faces;             ///< four local faces a cell
    std::vector<unsigned int> other_side; ///< 4 * cell + face of a face's second cell, or none
    State                     state;
    std::vector<double>       old_gradient, old_change, direction, image;
  };
} // namespace tetradapt::estimate

#endif
