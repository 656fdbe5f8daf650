// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_mesh_partition_h
#define tetradapt_mechanics_mesh_partition_h

#include "tetradapt/mesh/tet_mesh.h"

#include <deal.II/grid/tria.h>

#include <memory>

namespace tetradapt::mechanics
{
  /**
   * The deal.II triangulation of a TetMesh, distributed over the ranks of a
   * communicator: a plain Triangulation on one rank, and on several a
   * parallel::fullydistributed::Triangulation partitioned by METIS.
   *
   * Cells are handed to deal.II sorted along a Morton curve, so that unknowns
   * numbered cell by cell lie close together in memory; mesh_cell() leads back.
   */
  class MeshPartition
  {
  public:
    /** Collective; every rank passes the same mesh, which must be finalized and
     * outlive this object. */
    MeshPartition(const mesh::TetMesh &mesh, MPI_Comm communicator);

    const dealii::Triangulation<3> &
    triangulation() const
    {
      return *tria;
    }
    MPI_Comm
    communicator() const
    {
      return mpi_communicator;
    }
    const mesh::TetMesh &
    mesh() const
    {
      return tet_mesh;
    }
    /** The number in the TetMesh of an active cell of the triangulation. */
    unsigned int
    mesh_cell(const dealii::Triangulation<3>::active_cell_iterator &cell) const;

  private:
    const mesh::TetMesh                      &tet_mesh;
    MPI_Comm                                  mpi_communicator;
    std::vector<unsigned int>                 cell_order; ///< triangulation's -> mesh's number
    std::unique_ptr<dealii::Triangulation<3>> tria;
  };
} // namespace tetradapt::mechanics

#endif
