// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_displacement_space_h
#define tetradapt_mechanics_displacement_space_h

#include "tetradapt/mechanics/mesh_partition.h"
#include "tetradapt/mesh/nodal_field.h"

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/la_parallel_vector.h>

namespace tetradapt::mechanics
{
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /**
   * The continuous displacements of degree 1 or 2 on a partitioned mesh, and the
   * numbering of their nodes over the ranks.
   *
   * Nodes are numbered in the order in which the partition's cells first name them, and so
   * rank by rank: of the ranks whose cells have a node, the first owns it. Component c of
   * node i is unknown 3 i + c. A node has a number in the NodalField ("field
   * node"), the same on every rank, and on the ranks that need it a "local node":
   * first the nodes that the rank owns, then the ghosts.
   */
  class DisplacementSpace
  {
  public:
    /** Collective. @p edges is needed for degree 2; it and the partition's mesh must
     * outlive this object. */
    DisplacementSpace(const MeshPartition   &partition,
                      unsigned int           degree,
                      const mesh::EdgeTable *edges);

    unsigned int
    degree() const
    {
      return polynomial_degree;
    }
    /** 4 or 10. */
    unsigned int
    n_nodes_per_cell() const
    {
      return polynomial_degree == 1 ? 4 : 10;
    }
    /** 3 times the number of nodes, over all ranks. */
    unsigned long
    n_dofs() const
    {
      return partitioner->size();
    }
    unsigned int
    n_owned_nodes() const
    {
      return n_owned;
    }
    unsigned int
    n_local_nodes() const
    {
      return field_nodes.size();
    }
    /** The field node of a local node. */
    unsigned int
    field_node(unsigned int local_node) const
    {
      return field_nodes[local_node];
    }
    /** The local node of a field node; numbers::invalid_unsigned_int elsewhere. */
    unsigned int
    local_node(unsigned int field_node) const
    {
      return local_nodes[field_node];
    }
    /** Global number of a local node. */
    dealii::types::global_dof_index
    global_node(unsigned int local_node) const
    {
      return partitioner->local_to_global(3 * local_node) / 3;
    }
    /** Mesh cells that touch a node owned by this rank, in the order of the
     * partition: what assembling complete rows needs. Also the rank's other cells, so
     * that each node that it owns in one space has its neighbours in spaces of another
     * degree on the same partition. */
    const std::vector<unsigned int> &
    touching_cells() const
    {
      return cells;
    }
    /** Field node @p i (vertices, then edges) of mesh cell @p cell. */
    unsigned int
    cell_node(unsigned int cell, unsigned int i) const
    {
      return i < 4 ? mesh.cells[cell][i] : mesh.n_points() + edges->cell_edges[cell][i - 4];
    }
    unsigned int
    n_field_nodes() const
    {
      return local_nodes.size();
    }
    const mesh::TetMesh &
    tet_mesh() const
    {
      return mesh;
    }
    const mesh::EdgeTable *
    edge_table() const
    {
      return edges;
    }
    MPI_Comm
    communicator() const
    {
      return mpi_communicator;
    }
    /** Layout of vectors: owned and ghost unknowns of this rank. */
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_layout() const
    {
      return partitioner;
    }

    /** Puts the owned values of @p vector in @p field, on every rank. Collective. */
    void
    gather(const Vector &vector, std::vector<dealii::Tensor<1, 3>> &field) const;

  private:
    /** Numbers all nodes of the mesh; returns the first number of each rank, then how many
     * there are. */
    std::vector<unsigned int>
    number(const MeshPartition &partition, std::vector<unsigned int> &numbers) const;
    /** Finds touching_cells(); the rank owns the numbers from @p begin to before @p end. */
    void
    find_cells(const MeshPartition             &partition,
               unsigned int                     rank,
               const std::vector<unsigned int> &numbers,
               unsigned int                     begin,
               unsigned int                     end);
    /** The nodes of other ranks that touching_cells() have, by number. */
    void
    add_ghosts(const std::vector<unsigned int> &numbers, unsigned int begin, unsigned int end);

    const mesh::TetMesh                                       &mesh;
    const mesh::EdgeTable                                     *edges;
    unsigned int                                               polynomial_degree;
    MPI_Comm                                                   mpi_communicator;
    unsigned int                                               n_owned = 0;
    std::vector<unsigned int>                                  field_nodes, local_nodes, cells;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
  };
} // namespace tetradapt::mechanics

#endif
