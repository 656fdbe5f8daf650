// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_fem_partition_h
#define tetradapt_fem_partition_h

#include "tetradapt/mesh/tet_mesh.h"

#include <mpi.h>

#include <memory>

namespace tetradapt::fem
{
  /**
   * The cells of a TetMesh shared out among the MPI ranks, in the order in which they are
   * worked on.
   *
   * The order follows a curve through space, so that what is numbered cell by cell lies
   * close together in memory. The ranks get equally many cells: the body is cut in two at
   * right angles to its longest extent, and so on (recursive coordinate bisection). Every
   * rank holds the whole mesh and computes the same partition, without communication.
   */
  class Partition
  {
  public:
    /** Every rank passes the same mesh, which is shared. */
    Partition(std::shared_ptr<const mesh::TetMesh> mesh, MPI_Comm communicator);

    MPI_Comm
    communicator() const
    {
      return mpi_communicator;
    }
    unsigned int
    n_ranks() const
    {
      return rank_count;
    }
    const mesh::TetMesh &
    mesh() const
    {
      return *tet_mesh;
    }
    const std::shared_ptr<const mesh::TetMesh> &
    shared_mesh() const
    {
      return tet_mesh;
    }
    /** All cells of the mesh, rank by rank, those of each rank along the curve. */
    const std::vector<unsigned int> &
    order() const
    {
      return cell_order;
    }
    /** Where the cells of @p rank begin in order(); those of the last end with
     * first_cell(n_ranks()). */
    unsigned int
    first_cell(unsigned int rank) const
    {
      return firsts[rank];
    }

  private:
    std::shared_ptr<const mesh::TetMesh> tet_mesh;
    MPI_Comm                             mpi_communicator;
    unsigned int                         rank_count;
    std::vector<unsigned int>            cell_order, firsts;
  };
} // namespace tetradapt::fem

#endif
