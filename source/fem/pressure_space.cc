// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/fem/pressure_space.h"

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace tetradapt::fem
{
  using dealii::numbers::invalid_unsigned_int;

  PressureSpace::PressureSpace(std::shared_ptr<const Space>               displacements,
                               std::shared_ptr<const mesh::PressureNodes> nodes)
    : displacement_space(std::move(displacements)), pressure_nodes(std::move(nodes)),
      local_nodes(pressure_nodes->size(), invalid_unsigned_int)
  {
    // Nodes in the order in which cells meet them, which lie in the order of space.
    std::vector<unsigned int> owned, ghosts;
    std::vector<char>         met(pressure_nodes->size(), 0);
    for (const unsigned int cell : displacement_space->touching_cells())
      for (unsigned int i = 0; i < 4; ++i)
        {
          const unsigned int node = pressure_nodes->node(cell, i);
          if (met[node] != 0)
            continue;
          met[node]            = 1;
          const bool is_my_own = displacement_space->local_node(pressure_nodes->vertex(node))
                                 < displacement_space->n_owned_nodes();
          (is_my_own ? owned : ghosts).push_back(node);
        }

    const MPI_Comm communicator = displacement_space->communicator();
    unsigned long  n_mine = owned.size(), begin = 0;
    MPI_Exscan(&n_mine, &begin, 1, MPI_UNSIGNED_LONG, MPI_SUM, communicator);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      begin = 0;
    const unsigned long n_all = dealii::Utilities::MPI::sum(n_mine, communicator);

    // Every rank knows every node's global number: a small vector compared with the mesh.
    std::vector<unsigned long> global(pressure_nodes->size(), 0);
    for (unsigned int k = 0; k < owned.size(); ++k)
      global[owned[k]] = begin + k;
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      MPI_Allreduce(
        MPI_IN_PLACE, global.data(), global.size(), MPI_UNSIGNED_LONG, MPI_SUM, communicator);

    dealii::IndexSet                             mine(n_all), seen(n_all);
    std::vector<dealii::types::global_dof_index> numbers;
    for (const unsigned int node : ghosts)
      numbers.push_back(global[node]);
    std::sort(numbers.begin(), numbers.end());
    mine.add_range(begin, begin + n_mine);
    seen.add_indices(numbers.begin(), numbers.end());
    layout = std::make_shared<dealii::Utilities::MPI::Partitioner>(mine, seen, communicator);

    field_nodes.resize(owned.size() + ghosts.size());
    for (const auto *list : {&owned, &ghosts})
      for (const unsigned int node : *list)
        {
          local_nodes[node]              = layout->global_to_local(global[node]);
          field_nodes[local_nodes[node]] = node;
        }
  }
} // namespace tetradapt::fem
