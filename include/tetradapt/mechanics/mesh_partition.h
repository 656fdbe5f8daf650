// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_mesh_partition_h
#define tetradapt_mechanics_mesh_partition_h

#include "tetradapt/mesh/tet_mesh.h"

#include <mpi.h>

namespace tetradapt::mechanics
{
  /**
   * The cells of a TetMesh in the order in which they are worked on, and the MPI rank that
   * owns each.
   *
   * The order follows a curve through space, so that what is numbered cell by cell lies
   * close together in memory. The ranks get equally many cells: the body is cut in two at
   * right angles to its longest extent, and so on (recursive coordinate bisection). Every
   * rank holds the whole mesh and computes the same partition, without communication.
   */
  class MeshPartition
  {
  public:
    /** Every rank passes the same mesh, which must outlive this object. */
    MeshPartition(const mesh::TetMesh &mesh, MPI_Comm communicator);

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
      return tet_mesh;
    }
    /** All cells of the mesh, along the curve. */
    const std::vector<unsigned int> &
    order() const
    {
      return cell_order;
    }
    /** The rank that owns cell @p cell of the mesh. */
    unsigned int
    owner(unsigned int cell) const
    {
      return owners.empty() ? 0 : owners[cell];
    }

  private:
    const mesh::TetMesh      &tet_mesh;
    MPI_Comm                  mpi_communicator;
    unsigned int              rank_count;
    std::vector<unsigned int> cell_order;
    std::vector<unsigned int> owners; ///< empty on one rank
  };
} // namespace tetradapt::mechanics

#endif
