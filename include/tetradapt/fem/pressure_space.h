// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_fem_pressure_space_h
#define tetradapt_fem_pressure_space_h

#include "tetradapt/fem/space.h"

namespace tetradapt::fem
{
  /**
   * The pressures of degree 1 that belong to displacements of degree 2 (Taylor and Hood), and the
   * numbering of their nodes over the ranks. A node belongs to the rank that owns the
   * displacement at its vertex. As in Space, local nodes are first those that the
   * rank owns, then ghosts.
   */
  class PressureSpace
  {
  public:
    /** Collective. @p displacements, which must have degree 2, are shared. */
    PressureSpace(std::shared_ptr<const Space>               displacements,
                  std::shared_ptr<const mesh::PressureNodes> nodes);

    const Space &
    displacements() const
    {
      return *displacement_space;
    }
    unsigned int
    n_owned_nodes() const
    {
      return layout->locally_owned_size();
    }
    /** Over all ranks. */
    unsigned long
    n_dofs() const
    {
      return layout->size();
    }
    /** The number in PressureNodes of a local node. */
    unsigned int
    field_node(unsigned int local_node) const
    {
      return field_nodes[local_node];
    }
    unsigned int
    n_local_nodes() const
    {
      return field_nodes.size();
    }
    /** Local node at local vertex @p i of a cell that touches an owned node. */
    unsigned int
    cell_node(unsigned int cell, unsigned int i) const
    {
      return local_nodes[pressure_nodes->node(cell, i)];
    }
    const std::shared_ptr<const mesh::PressureNodes> &
    nodes() const
    {
      return pressure_nodes;
    }
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_layout() const
    {
      return layout;
    }

  private:
    std::shared_ptr<const Space>                               displacement_space;
    std::shared_ptr<const mesh::PressureNodes>                 pressure_nodes;
    std::vector<unsigned int>                                  field_nodes, local_nodes;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
  };
} // namespace tetradapt::fem

#endif
