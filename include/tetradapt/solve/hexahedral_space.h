// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_space_h
#define tetradapt_solve_hexahedral_space_h

#include "tetradapt/solve/hexahedral_forest.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

namespace tetradapt::solve
{
  using Vector      = dealii::LinearAlgebra::distributed::Vector<double>;
  using Constraints = dealii::AffineConstraints<double>;

  /** The continuous displacements of one degree on the cells of a forest: a DoFHandler with
   * FESystem<3>(FE_Q<3>(degree), 3), and the constraints of nodes in the middle of a larger
   * neighbour's face or edge, whose value is a mean of others ("hanging"). */
  class HexahedralSpace
  {
  public:
    using Dofs = std::vector<dealii::types::global_dof_index>;

    /** Degree 1, 2 or 3. Keeps a reference to @p forest. Collective. */
    HexahedralSpace(const HexahedralForest &forest, unsigned int degree);

    const HexahedralForest &
    forest() const
    {
      return hexahedral_forest;
    }
    unsigned int
    degree() const
    {
      return handler.get_fe().degree;
    }
    unsigned int
    nodes_per_cell() const
    {
      return order.size() / 3;
    }
    const dealii::DoFHandler<3> &
    dof_handler() const
    {
      return handler;
    }
    /** Closed. */
    const Constraints &
    hanging_nodes() const
    {
      return hanging;
    }
    /** The same, for others to be added; not closed. */
    Constraints
    make_constraints() const;
    /** Unknowns over all ranks, without hanging ones. */
    unsigned long
    n_dofs() const
    {
      return n_free_dofs;
    }
    /** The unknowns of the forest's own cell @p cell, node by node, along x first: component c
     * of node i is entry 3 i + c. */
    void
    get_dofs(unsigned int cell, Dofs &dofs) const;

  private:
    const HexahedralForest   &hexahedral_forest;
    dealii::DoFHandler<3>     handler;
    std::vector<unsigned int> order; ///< the place in deal.II's list of each entry of get_dofs()
    Constraints               hanging;
    unsigned long             n_free_dofs = 0;
    mutable Dofs              in_deal_ii_order;
  };
} // namespace tetradapt::solve

#endif
