// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_space.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

namespace tetradapt::solve
{
  HexahedralSpace::HexahedralSpace(const HexahedralForest &forest, const unsigned int degree)
    : hexahedral_forest(forest), handler(forest.triangulation())
  {
    const dealii::FE_Q<3>     scalar(degree);
    const dealii::FESystem<3> element(scalar, 3);
    handler.distribute_dofs(element);
    order.resize(element.n_dofs_per_cell());
    in_deal_ii_order.resize(order.size());
    const auto place = scalar.get_poly_space_numbering();
    for (unsigned int i = 0; i < order.size(); ++i)
      {
        const auto component_and_node = element.system_to_component_index(i);
        order[3 * place[component_and_node.second] + component_and_node.first] = i;
      }
    hanging = make_constraints();
    hanging.close();
    unsigned long n_free = 0;
    for (const auto dof : handler.locally_owned_dofs())
      n_free += hanging.is_constrained(dof) ? 0 : 1;
    n_free_dofs = dealii::Utilities::MPI::sum(n_free, forest.communicator());
  }

  Constraints
  HexahedralSpace::make_constraints() const
  {
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(handler, relevant);
#if DEAL_II_VERSION_GTE(9, 6, 0)
    Constraints constraints(handler.locally_owned_dofs(), relevant);
#else
    Constraints constraints(relevant);
#endif
    dealii::DoFTools::make_hanging_node_constraints(handler, constraints);
    return constraints;
  }

  void
  HexahedralSpace::get_dofs(const unsigned int cell, Dofs &dofs) const
  {
    const auto                                       &own = hexahedral_forest.own_cells()[cell];
    const dealii::DoFHandler<3>::active_cell_iterator iterator(&hexahedral_forest.triangulation(),
                                                               own->level(),
                                                               own->index(),
                                                               &handler);
    iterator->get_dof_indices(in_deal_ii_order);
    dofs.resize(order.size());
    for (unsigned int i = 0; i < order.size(); ++i)
      dofs[i] = in_deal_ii_order[order[i]];
  }
} // namespace tetradapt::solve
