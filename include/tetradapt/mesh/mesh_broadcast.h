// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_mesh_broadcast_h
#define tetradapt_mesh_mesh_broadcast_h

#include "tetradapt/mesh/tet_mesh.h"

#include <mpi.h>

#include <functional>
#include <memory>

namespace tetradapt::mesh
{
  /** Gives @p mesh from the first rank to all. Collective. */
  void
  broadcast(TetMesh &mesh, MPI_Comm communicator);

  /** A mesh that @p make returns on the first rank, on every rank. What it throws
   * is thrown on every rank. Collective. */
  std::shared_ptr<const TetMesh>
  make_on_first_rank(MPI_Comm communicator, const std::function<TetMesh()> &make);
} // namespace tetradapt::mesh

#endif
