// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/displacement_space.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>

namespace tetradapt::mechanics
{
  namespace
  {
    using dealii::IndexSet;
    using dealii::types::global_dof_index;

    /** The unknowns of a set of nodes, three each. */
    IndexSet
    triple(const IndexSet &nodes)
    {
      IndexSet unknowns(3 * nodes.size());
      for (auto interval = nodes.begin_intervals(); interval != nodes.end_intervals(); ++interval)
        unknowns.add_range(3 * *interval->begin(), 3 * (interval->last() + 1));
      unknowns.compress();
      return unknowns;
    }
  } // namespace

  DisplacementSpace::DisplacementSpace(const MeshPartition   &partition,
                                       unsigned int           degree,
                                       const mesh::EdgeTable *edges)
    : mesh(partition.mesh()), edges(edges), polynomial_degree(degree),
      mpi_communicator(partition.communicator())
  {
    dealii::DoFHandler<3> dof_handler(partition.triangulation());
    dof_handler.distribute_dofs(dealii::FE_SimplexP<3>(degree));

    const IndexSet &owned = dof_handler.locally_owned_dofs();
    IndexSet        relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    partitioner = std::make_shared<dealii::Utilities::MPI::Partitioner>(triple(owned),
                                                                        triple(relevant),
                                                                        mpi_communicator);
    n_owned     = owned.n_elements();
    field_nodes.assign(n_owned + partitioner->n_ghost_indices() / 3,
                       dealii::numbers::invalid_unsigned_int);
    local_nodes.assign(mesh.n_points() + (degree == 2 ? edges->edges.size() : 0),
                       dealii::numbers::invalid_unsigned_int);

    const unsigned int            n_per_cell = n_nodes_per_cell();
    std::vector<global_dof_index> dofs(n_per_cell);
    std::vector<unsigned int>     local(n_per_cell);
    cells.reserve(partition.triangulation().n_active_cells());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          const unsigned int mesh_cell = partition.mesh_cell(cell);
          cell->get_dof_indices(dofs);
          bool touches_owned = false;
          for (unsigned int i = 0; i < n_per_cell; ++i)
            {
              const unsigned int l = partitioner->global_to_local(3 * dofs[i]) / 3;
              const unsigned int f = cell_node(mesh_cell, i);
              field_nodes[l]       = f;
              local_nodes[f]       = l;
              touches_owned |= l < n_owned;
            }
          if (touches_owned)
            cells.push_back(mesh_cell);
        }
  }

  void
  DisplacementSpace::gather(const Vector &vector, std::vector<dealii::Tensor<1, 3>> &field) const
  {
    field.assign(n_field_nodes(), dealii::Tensor<1, 3>());
    for (unsigned int l = 0; l < n_owned; ++l)
      for (unsigned int c = 0; c < 3; ++c)
        field[field_nodes[l]][c] = vector.local_element(3 * l + c);
    if (partitioner->n_mpi_processes() > 1)
      {
        static_assert(sizeof(dealii::Tensor<1, 3>) == 3 * sizeof(double));
        MPI_Allreduce(
          MPI_IN_PLACE, field.data(), 3 * field.size(), MPI_DOUBLE, MPI_SUM, mpi_communicator);
      }
  }
} // namespace tetradapt::mechanics
