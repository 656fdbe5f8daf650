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
      mpi_communicator(partition.communicator())
  {
    const unsigned int        rank = dealii::Utilities::MPI::this_mpi_process(mpi_communicator);
    std::vector<unsigned int> numbers;
    const auto                firsts = number(partition, numbers);
    const unsigned int        begin = firsts[rank], end = firsts[rank + 1];
    n_owned = end - begin;
    field_nodes.resize(n_owned);
    for (unsigned int node = 0; node < numbers.size(); ++node)
      if (numbers[node] >= begin && numbers[node] < end)
        field_nodes[numbers[node] - begin] = node;
    find_cells(partition, rank, numbers, begin, end);

    IndexSet owned(3 * global_dof_index(firsts.back())), ghosts(owned.size());
    owned.add_range(3 * global_dof_index(begin), 3 * global_dof_index(end));
    if (partition.n_ranks() == 1)
      local_nodes = std::move(numbers);
    else
      {
        add_ghosts(numbers, begin, end);
        local_nodes.assign(numbers.size(), invalid);
        for (unsigned int l = 0; l < field_nodes.size(); ++l)
          local_nodes[field_nodes[l]] = l;
        for (unsigned int l = n_owned; l < field_nodes.size(); ++l)
          {
            const global_dof_index global = numbers[field_nodes[l]];
            ghosts.add_range(3 * global, 3 * (global + 1));
          }
        ghosts.compress();
      }
    partitioner
      = std::make_shared<dealii::Utilities::MPI::Partitioner>(owned, ghosts, mpi_communicator);
  }

  std::vector<unsigned int>
  DisplacementSpace::number(const MeshPartition       &partition,
                            std::vector<unsigned int> &numbers) const
  {
    numbers.assign(mesh.n_points() + (polynomial_degree == 2 ? edges->edges.size() : 0), invalid);
    std::vector<unsigned int> firsts(partition.n_ranks() + 1, 0);
    unsigned int              next = 0;
    for (unsigned int rank = 0; rank < partition.n_ranks(); ++rank)
      {
        firsts[rank] = next;
        for (unsigned int k = partition.first_cell(rank); k < partition.first_cell(rank + 1); ++k)
          for (unsigned int i = 0; i < n_nodes_per_cell(); ++i)
            {
              unsigned int &number = numbers[cell_node(partition.order()[k], i)];
              if (number == invalid)
                number = next++;
            }
      }
    firsts.back() = next; // points without cells have no number
    return firsts;
  }

  void
  DisplacementSpace::find_cells(const MeshPartition             &partition,
                                unsigned int                     rank,
                                const std::vector<unsigned int> &numbers,
                                unsigned int                     begin,
                                unsigned int                     end)
  {
    const auto &order = partition.order();
    if (partition.n_ranks() == 1)
      {
        cells = order;
        return;
      }
    const unsigned int first = partition.first_cell(rank), last = partition.first_cell(rank + 1);
    std::vector<unsigned char> is_near(mesh.n_points(), 0); // points of the rank's cells
    for (unsigned int k = first; k < last; ++k)
      for (const unsigned int point : mesh.cells[order[k]])
        is_near[point] = 1;
    const auto is_needed = [&](unsigned int cell) {
      const auto &points = mesh.cells[cell];
      if (std::none_of(points.begin(), points.end(), [&](auto p) { return is_near[p] != 0; }))
        return false; // most are far
      for (unsigned int i = 0; i < n_nodes_per_cell(); ++i)
        if (numbers[cell_node(cell, i)] >= begin && numbers[cell_node(cell, i)] < end)
          return true;
      return false;
    };
    for (unsigned int k = 0; k < order.size(); ++k)
      if ((k >= first && k < last) || is_needed(order[k]))
        cells.push_back(order[k]);
  }

  void
  DisplacementSpace::add_ghosts(const std::vector<unsigned int> &numbers,
                                unsigned int                     begin,
                                unsigned int                     end)
  {
    std::vector<unsigned int> ghosts;
    for (const unsigned int cell : cells)
      for (unsigned int i = 0; i < n_nodes_per_cell(); ++i)
        {
          const unsigned int node = cell_node(cell, i);
          if (numbers[node] < begin || numbers[node] >= end)
            ghosts.push_back(node);
        }
    std::sort(ghosts.begin(), ghosts.end(), [&](unsigned int i, unsigned int j) {
      return numbers[i] < numbers[j];
    });
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    field_nodes.insert(field_nodes.end(), ghosts.begin(), ghosts.end());
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
