// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_improvement_h
#define tetradapt_estimate_equilibrated_improvement_h

#include "relaxation.h"

#include <mpi.h>

namespace tetradapt::estimate
{
  /**
   * Lowers the energy of equilibrated tractions on the whole mesh by
   * TractionRelaxation, part by part so that memory is bounded: first each rank its
   * own cells, then all ranks alike what crosses the borders of parts, until nothing
   * is left. Collective.
   *
   * @param moments see FaceTractions; on each rank those of the faces of its own cells
   *        are needed. The same on all ranks after.
   */
  void
  improve_tractions(const mesh::TetMesh &mesh,
                    const CellFaces     &faces,
                    const TractionMoves &moves,
                    const CellStates    &states,
                    MPI_Comm             communicator,
                    std::vector<double> &moments);
} // namespace tetradapt::estimate

#endif
