// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/fem/space.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/fem/triangulation.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

namespace tetradapt::fem
{
  using dealii::IndexSet;
  using dealii::types::global_dof_index;

  namespace
  {
    constexpr unsigned int invalid = dealii::numbers::invalid_unsigned_int;
  }

  Space::Space(std::shared_ptr<const Triangulation>   triangulation,
               const unsigned int                     degree,
               std::shared_ptr<const mesh::EdgeTable> edge_table)
    : Space(std::move(triangulation), std::move(edge_table), degree)
  {
    AssertThrow(degree == 1 || degree == 2, dealii::ExcNotImplemented());
    if (degree == 2 && edges == nullptr)
      edges = std::make_shared<const mesh::EdgeTable>(mesh::build_edges(mesh));
    // Local numbers, and MPI's counts, are signed in places.
    const std::uint64_t n_unknowns
      = 3 * (std::uint64_t(mesh.n_points()) + (degree == 2 ? edges->edges.size() : 0));
    if (n_unknowns > std::numeric_limits<std::int32_t>::max())
      throw core::NumericalError("The mesh has " + std::to_string(n_unknowns)
                                 + " unknowns, more than the "
                                 + std::to_string(std::numeric_limits<std::int32_t>::max())
                                 + " that can be numbered. Use a coarser mesh.");
    handler = std::make_unique<dealii::DoFHandler<3>>(*body);
    handler->distribute_dofs(dealii::FESystem<3>(dealii::FE_SimplexP<3>(degree), 3));
    std::vector<global_dof_index> nodes;
    list_cells(nodes);
    number_locally(handler->locally_owned_dofs(), nodes);
  }

  Space::Space(std::shared_ptr<const Triangulation>   triangulation,
               std::shared_ptr<const mesh::EdgeTable> edges,
               const unsigned int                     degree)
    : body(std::move(triangulation)), mesh(body->tet_mesh()),
      mpi_communicator(body->partition().communicator()), edges(std::move(edges)),
      polynomial_degree(degree)
  {
  }

  std::unique_ptr<Space>
  Space::linear_part(const Space &quadratic)
  {
    std::unique_ptr<Space>        space(new Space(quadratic.body, quadratic.edges, 1));
    std::vector<global_dof_index> nodes;
    const IndexSet                owned = space->list_cells_of(quadratic, nodes);
    space->number_locally(owned, nodes);
    return space;
  }

  Space::~Space() = default;

  void
  Space::list_cells(std::vector<global_dof_index> &nodes)
  {
    const IndexSet               &owned   = handler->locally_owned_dofs();
    const unsigned int            n_nodes = n_nodes_per_cell();
    std::vector<global_dof_index> dofs(3 * n_nodes);
    cells.reserve(body->n_active_cells());
    nodes.reserve(std::size_t(body->n_active_cells()) * n_nodes);
    for (const auto &cell : handler->active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        cell->get_dof_indices(dofs);
        if (cell->is_ghost()
            && std::none_of(dofs.begin(), dofs.end(), [&](auto i) { return owned.is_element(i); }))
          continue;
        cells.push_back(body->mesh_cell(cell->index()));
        is_ghost.push_back(cell->is_ghost());
        for (unsigned int i = 0; i < n_nodes; ++i)
          nodes.push_back(dofs[3 * i] / 3);
      }
  }

  IndexSet
  Space::list_cells_of(const Space &quadratic, std::vector<global_dof_index> &nodes)
  {
    std::vector<unsigned int> vertices; // local nodes of the quadratic space
    for (unsigned int node = 0; node < quadratic.n_owned; ++node)
      if (quadratic.field_nodes[node] < mesh.n_points())
        vertices.push_back(node);
    const global_dof_index n_mine = vertices.size();
    global_dof_index       before = 0;
    MPI_Exscan(&n_mine, &before, 1, DEAL_II_DOF_INDEX_MPI_TYPE, MPI_SUM, mpi_communicator);
    if (dealii::Utilities::MPI::this_mpi_process(mpi_communicator) == 0)
      before = 0; // MPI leaves it undefined
    IndexSet owned(3 * dealii::Utilities::MPI::sum(n_mine, mpi_communicator));
    owned.add_range(3 * before, 3 * (before + n_mine));

    // Owners tell the numbers of ghosts; doubles hold them exactly.
    Vector numbers(quadratic.partitioner);
    for (unsigned int i = 0; i < vertices.size(); ++i)
      numbers.local_element(3 * vertices[i]) = before + i;
    numbers.update_ghost_values();
    const unsigned int n_nodes = quadratic.n_nodes_per_cell();
    nodes.reserve(4 * quadratic.cells.size());
    for (unsigned int k = 0; k < quadratic.cells.size(); ++k)
      {
        const unsigned int *of_cell = &quadratic.cell_nodes[std::size_t(k) * n_nodes];
        if (quadratic.is_ghost[k] && std::all_of(of_cell, of_cell + 4, [&](auto node) {
              return node >= quadratic.n_owned;
            }))
          continue;
        cells.push_back(quadratic.cells[k]);
        is_ghost.push_back(quadratic.is_ghost[k]);
        for (unsigned int i = 0; i < 4; ++i)
          nodes.push_back(numbers.local_element(3 * of_cell[i]));
      }
    return owned;
  }

  void
  Space::number_locally(const IndexSet &owned, const std::vector<global_dof_index> &nodes)
  {
    const global_dof_index begin = owned.n_elements() > 0 ? *owned.begin() / 3 : 0;
    n_owned                      = owned.n_elements() / 3;

    std::vector<global_dof_index> ghosts;
    for (const global_dof_index node : nodes)
      if (node < begin || node - begin >= n_owned)
        ghosts.push_back(node);
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    IndexSet ghost_dofs(owned.size());
    for (const global_dof_index node : ghosts)
      ghost_dofs.add_range(3 * node, 3 * (node + 1));
    ghost_dofs.compress();
    partitioner
      = std::make_shared<dealii::Utilities::MPI::Partitioner>(owned, ghost_dofs, communicator());

    cell_nodes.reserve(nodes.size());
    for (const global_dof_index node : nodes)
      cell_nodes.push_back(
        node >= begin && node - begin < n_owned
          ? node - begin
          : n_owned + (std::lower_bound(ghosts.begin(), ghosts.end(), node) - ghosts.begin()));

    field_nodes.resize(n_owned + ghosts.size());
    local_nodes.assign(tet_mesh().n_points() + (polynomial_degree == 2 ? edges->edges.size() : 0),
                       invalid);
    for (unsigned int k = 0; k < cells.size(); ++k)
      for (unsigned int i = 0; i < n_nodes_per_cell(); ++i)
        {
          const unsigned int local = local_nodes_of(k)[i], field = cell_node(cells[k], i);
          field_nodes[local] = field;
          local_nodes[field] = local;
        }
  }

  const std::shared_ptr<const mesh::TetMesh> &
  Space::shared_mesh() const
  {
    return body->shared_mesh();
  }

  dealii::Point<3>
  Space::node_position(const unsigned int local_node) const
  {
    const unsigned int node = field_nodes[local_node];
    if (node < mesh.n_points())
      return mesh.points[node];
    const auto &edge = edges->edges[node - mesh.n_points()];
    return mesh.points[edge[0]] + 0.5 * (mesh.points[edge[1]] - mesh.points[edge[0]]);
  }
} // namespace tetradapt::fem
