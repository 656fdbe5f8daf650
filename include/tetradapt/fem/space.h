// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_fem_space_h
#define tetradapt_fem_space_h

#include "tetradapt/mesh/nodal_field.h"

#include <deal.II/base/partitioner.h>
#include <deal.II/base/template_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <memory>

// The header of DoFHandler is one of the most expensive to compile.
DEAL_II_NAMESPACE_OPEN
template <int dim, int spacedim>
#if DEAL_II_VERSION_GTE(9, 5, 0)
DEAL_II_CXX20_REQUIRES((concepts::is_valid_dim_spacedim<dim, spacedim>))
#endif
class DoFHandler;
DEAL_II_NAMESPACE_CLOSE

namespace tetradapt::fem
{
  class Triangulation;

  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /**
   * The continuous displacements of degree 1 or 2 on a triangulation: deal.II's DoFHandler with
   * FESystem<3>(FE_SimplexP<3>(degree), 3), and tables of its numbers for kernels, which take
   * nodes instead of unknowns.
   *
   * deal.II numbers such a space node by node, in the order in which the cells of the ranks,
   * one after the other, first name the nodes: component c of node i is unknown 3 i + c, and of
   * the ranks whose cells have a node, the first owns it. A node that a rank needs has a "local
   * node" number there: first those that the rank owns, then ghosts. Its number in a
   * mesh::NodalField, the same on every rank, is its "field node".
   */
  class Space
  {
  public:
    /**
     * Collective. Shares the triangulation, and with it the mesh. @p edges of the mesh are shared
     * for degree 2, or made if null.
     * @throws dealii::ExcNotImplemented for another degree.
     * @throws core::NumericalError for more unknowns than can be numbered.
     */
    Space(std::shared_ptr<const Triangulation>   triangulation,
          unsigned int                           degree,
          std::shared_ptr<const mesh::EdgeTable> edges = nullptr);

    /**
     * The displacements of degree 1 on the triangulation of @p quadratic, which are a subspace
     * of that: for multigrid. Numbered by those of its nodes that are vertices, in their order,
     * which are the numbers that a DoFHandler would give, without the time that one takes.
     * Collective. Shares the triangulation, but not @p quadratic.
     */
    static std::unique_ptr<Space>
    linear_part(const Space &quadratic);

    ~Space();

    /** For FEValues and everything else in deal.II that takes one.
     * @throws dealii::ExcNotInitialized for a linear_part(), which has none. */

    const dealii::DoFHandler<3, 3> &
    dof_handler() const
    {
      AssertThrow(handler != nullptr, dealii::ExcNotInitialized());
      return *handler;
    }
    const Triangulation &
    triangulation() const
    {
      return *body;
    }
    const std::shared_ptr<const Triangulation> &
    shared_triangulation() const
    {
      return body;
    }
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
    dealii::types::global_dof_index
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
    field_node(const unsigned int local_node) const
    {
      return field_nodes[local_node];
    }
    /** The local node of a field node; numbers::invalid_unsigned_int elsewhere. */
    unsigned int
    local_node(const unsigned int field_node) const
    {
      return local_nodes[field_node];
    }
    /** Mesh cells that touch a node owned by this rank, in the order of the
     * partition: what assembling complete rows needs. Also the rank's other cells, so
     * that each node that it owns in one space has its neighbours in spaces of another
     * degree on the same triangulation. */
    const std::vector<unsigned int> &
    touching_cells() const
    {
      return cells;
    }
    /** Whether the k-th of touching_cells() is this rank's own: each cell is that of one rank,
     * which knows all of its nodes. Sums over the body take these. */
    bool
    is_own_cell(const unsigned int k) const
    {
      return !is_ghost[k];
    }
    /** The local nodes of the k-th of touching_cells(), n_nodes_per_cell() of them: vertices,
     * then edges in deal.II's order. */
    const unsigned int *
    local_nodes_of(const unsigned int k) const
    {
      return &cell_nodes[std::size_t(k) * n_nodes_per_cell()];
    }
    /** Field node @p i (vertices, then edges) of mesh cell @p cell. */
    unsigned int
    cell_node(const unsigned int cell, const unsigned int i) const
    {
      return i < 4 ? tet_mesh().cells[cell][i]
                   : tet_mesh().n_points() + edges->cell_edges[cell][i - 4];
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
    const std::shared_ptr<const mesh::TetMesh> &
    shared_mesh() const;
    /** Null for degree 1 if none was given. */
    const mesh::EdgeTable *
    edge_table() const
    {
      return edges.get();
    }
    const std::shared_ptr<const mesh::EdgeTable> &
    shared_edges() const
    {
      return edges;
    }
    /** Rest position of a local node. */
    dealii::Point<3>
    node_position(unsigned int local_node) const;
    MPI_Comm
    communicator() const
    {
      return mpi_communicator;
    }
    /** Layout of vectors: the owned unknowns, and as ghosts the others of touching_cells(). */
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_layout() const
    {
      return partitioner;
    }

  private:
    /** Without any cells and numbers. */
    Space(std::shared_ptr<const Triangulation>   triangulation,
          std::shared_ptr<const mesh::EdgeTable> edges,
          unsigned int                           degree);
    /** Fills cells, and their nodes' numbers on all ranks in @p nodes. */
    void
    list_cells(std::vector<dealii::types::global_dof_index> &nodes);
    /** The same for a linear_part(). Returns the unknowns of this rank. */
    dealii::IndexSet
    list_cells_of(const Space &quadratic, std::vector<dealii::types::global_dof_index> &nodes);
    /** Makes the layout and the tables of local numbers. */
    void
    number_locally(const dealii::IndexSet                             &owned,
                   const std::vector<dealii::types::global_dof_index> &nodes);

    std::shared_ptr<const Triangulation>                       body;
    const mesh::TetMesh                                       &mesh;
    MPI_Comm                                                   mpi_communicator;
    std::shared_ptr<const mesh::EdgeTable>                     edges;
    unsigned int                                               polynomial_degree;
    std::unique_ptr<dealii::DoFHandler<3, 3>>                  handler;
    unsigned int                                               n_owned = 0;
    std::vector<unsigned int>                                  cells, cell_nodes;
    std::vector<bool>                                          is_ghost; ///< of cells
    std::vector<unsigned int>                                  field_nodes, local_nodes;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
  };
} // namespace tetradapt::fem

#endif
