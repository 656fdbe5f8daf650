// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/displacement_space.h"

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace tetradapt::mechanics
{
  using dealii::IndexSet;
  using dealii::types::global_dof_index;

  namespace
  {
    constexpr unsigned int invalid = dealii::numbers::invalid_unsigned_int;
  }

  DisplacementSpace::DisplacementSpace(const MeshPartition   &partition,
                                       unsigned int           degree,
                                       const mesh::EdgeTable *edges)
    : mesh(partition.mesh()), edges(edges), polynomial_degree(degree),
      mpi_communicator(partition.communicator()),
      local_nodes(mesh.n_points() + (degree == 2 ? edges->edges.size() : 0), invalid)
  {
    std::vector<global_dof_index> numbers;
    const auto                    firsts = number(partition, numbers);
    const unsigned int            rank = dealii::Utilities::MPI::this_mpi_process(mpi_communicator);
    const std::pair<global_dof_index, global_dof_index> range(firsts[rank], firsts[rank + 1]);
    const auto                                          is_owned = [&](unsigned int field_node) {
      return numbers[field_node] >= range.first && numbers[field_node] < range.second;
    };

    n_owned = range.second - range.first;
    field_nodes.resize(n_owned);
    for (unsigned int node = 0; node < numbers.size(); ++node)
      if (is_owned(node))
        {
          local_nodes[node]              = numbers[node] - range.first;
          field_nodes[local_nodes[node]] = node;
        }
    if (partition.n_ranks() == 1)
      cells = partition.order();
    else
      for (const unsigned int cell : partition.order())
        {
          bool needed = partition.owner(cell) == rank;
          for (unsigned int i = 0; i < n_nodes_per_cell() && !needed; ++i)
            needed = is_owned(cell_node(cell, i));
          if (needed)
            cells.push_back(cell);
        }
    add_ghosts(numbers, range);

    IndexSet owned(3 * firsts.back()), ghosts(3 * firsts.back());
    owned.add_range(3 * range.first, 3 * range.second);
    for (unsigned int l = n_owned; l < field_nodes.size(); ++l)
      ghosts.add_range(3 * numbers[field_nodes[l]], 3 * (numbers[field_nodes[l]] + 1));
    ghosts.compress();
    partitioner
      = std::make_shared<dealii::Utilities::MPI::Partitioner>(owned, ghosts, mpi_communicator);
  }

  std::vector<global_dof_index>
  DisplacementSpace::number(const MeshPartition           &partition,
                            std::vector<global_dof_index> &numbers) const
  {
    const unsigned int n_per_cell = n_nodes_per_cell(), n_ranks = partition.n_ranks();
    const auto         for_each = [&](const auto &action) {
      for (const unsigned int cell : partition.order())
        for (unsigned int i = 0; i < n_per_cell; ++i)
          action(cell_node(cell, i), partition.owner(cell));
    };
    std::vector<unsigned int> owners;
    if (n_ranks > 1)
      {
        owners.assign(n_field_nodes(), invalid);
        for_each([&](unsigned int node, unsigned int rank) {
          owners[node] = std::min(owners[node], rank);
        });
      }
    std::vector<global_dof_index> firsts(n_ranks + 1, 0);
    for (const unsigned int owner : owners)
      if (owner != invalid) // points without cells have none
        ++firsts[owner + 1];
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      firsts[rank + 1] += firsts[rank];

    auto next = firsts;
    numbers.assign(n_field_nodes(), dealii::numbers::invalid_dof_index);
    for_each([&](unsigned int node, unsigned int) {
      if (numbers[node] == dealii::numbers::invalid_dof_index)
        numbers[node] = next[n_ranks > 1 ? owners[node] : 0]++;
    });
    firsts.back() = next[n_ranks - 1];
    return firsts;
  }

  void
  DisplacementSpace::add_ghosts(const std::vector<global_dof_index>                 &numbers,
                                const std::pair<global_dof_index, global_dof_index> &owned)
  {
    if (owned.second - owned.first == numbers.size())
      return;
    std::vector<unsigned int> ghosts;
    for (const unsigned int cell : cells)
      for (unsigned int i = 0; i < n_nodes_per_cell(); ++i)
        {
          const unsigned int node = cell_node(cell, i);
          if (numbers[node] < owned.first || numbers[node] >= owned.second)
            ghosts.push_back(node);
        }
    std::sort(ghosts.begin(), ghosts.end(), [&](unsigned int i, unsigned int j) {
      return numbers[i] < numbers[j];
    });
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    for (const unsigned int node : ghosts)
      {
        local_nodes[node] = field_nodes.size();
        field_nodes.push_back(node);
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
