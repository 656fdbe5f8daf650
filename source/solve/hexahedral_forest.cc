// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_forest.h"

#include "tetradapt/core/exceptions.h"

#include <deal.II/base/config.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    using dealii::IndexSet;
    using dealii::types::global_dof_index;

    /** The three unknowns of each node. */
    IndexSet
    triple(const IndexSet &nodes)
    {
      IndexSet unknowns(3 * nodes.size());
      for (auto interval = nodes.begin_intervals(); interval != nodes.end_intervals(); ++interval)
        unknowns.add_range(3 * *interval->begin(), 3 * (interval->last() + 1));
      unknowns.compress();
      return unknowns;
    }

    dealii::AffineConstraints<double>
    hanging_nodes(const dealii::DoFHandler<3> &dof_handler)
    {
      IndexSet relevant;
      dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
#if DEAL_II_VERSION_GTE(9, 6, 0)
      dealii::AffineConstraints<double> constraints(dof_handler.locally_owned_dofs(), relevant);
#else
      dealii::AffineConstraints<double> constraints(relevant);
#endif
      dealii::DoFTools::make_hanging_node_constraints(dof_handler, constraints);
      constraints.close();
      return constraints;
    }

    /**
     * deal.II numbers hanging nodes as well, and nodes in an order that jumps. Here those
     * that do not hang are numbered in the order in which the cells meet them.
     */
    class Numbering
    {
    public:
      /** @p nodes: deal.II's numbers of all nodes of the own cells. Collective. */
      Numbering(const std::vector<global_dof_index>     &nodes,
                const IndexSet                          &owned,
                const dealii::AffineConstraints<double> &constraints,
                MPI_Comm                                 communicator)
        : first(owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0),
          local_of_owned(owned.n_elements(), none)
      {
        unsigned int n_own = 0;
        const auto   meet  = [&](const global_dof_index node) {
          if (constraints.is_constrained(node))
            throw core::NumericalError("A hanging node depends on another one: the hexahedra are "
                                          "not graded.");
          if (!owned.is_element(node))
            ghosts.push_back(node);
          else if (local_of_owned[node - first] == none)
            local_of_owned[node - first] = n_own++;
        };
        for (const global_dof_index node : nodes)
          if (!constraints.is_constrained(node))
            meet(node);
          else
            for (const auto &entry : *constraints.get_constraint_entries(node))
              meet(entry.first);
        // An owned node may be met by other ranks only.
        for (const auto node : owned)
          if (!constraints.is_constrained(node))
            meet(node);
        std::sort(ghosts.begin(), ghosts.end());
        ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
        make_layout(owned, n_own, communicator);
      }

      unsigned int
      n_owned() const
      {
        return layout->locally_owned_size() / 3;
      }
      unsigned int
      n_local() const
      {
        return n_owned() + ghosts.size();
      }
      unsigned int
      local(const global_dof_index node) const
      {
        if (node >= first && node - first < local_of_owned.size())
          return local_of_owned[node - first];
        return local_of_ghost[std::lower_bound(ghosts.begin(), ghosts.end(), node)
                              - ghosts.begin()];
      }

      std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;

    private:
      static constexpr unsigned int none = HexahedralGrid::none;

      void
      make_layout(const IndexSet &owned, const unsigned int n_own, MPI_Comm communicator)
      {
        unsigned long long own = n_own, end = 0; // of this rank's numbers
        MPI_Scan(&own, &end, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, communicator);
        const global_dof_index begin = end - own;
        const global_dof_index n_nodes
          = dealii::Utilities::MPI::sum(global_dof_index(n_own), communicator);
        IndexSet new_owned(n_nodes), new_ghosts(n_nodes);
        new_owned.add_range(begin, begin + n_own);
        // Owners tell the new numbers of their nodes. Numbers are exact as double.
        std::vector<global_dof_index> numbers(ghosts.size());
        if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
          {
            IndexSet old_ghosts(owned.size());
            old_ghosts.add_indices(ghosts.begin(), ghosts.end());
            Vector told(owned, old_ghosts, communicator);
            for (unsigned int i = 0; i < local_of_owned.size(); ++i)
              told.local_element(i) = double(begin) + local_of_owned[i];
            told.update_ghost_values();
            for (unsigned int g = 0; g < ghosts.size(); ++g)
              numbers[g] = told[ghosts[g]];
          }
        auto sorted = numbers;
        std::sort(sorted.begin(), sorted.end());
        for (const auto number : numbers)
          local_of_ghost.push_back(
            n_own + (std::lower_bound(sorted.begin(), sorted.end(), number) - sorted.begin()));
        new_ghosts.add_indices(sorted.begin(), sorted.end());
        layout = std::make_shared<dealii::Utilities::MPI::Partitioner>(triple(new_owned),
                                                                       triple(new_ghosts),
                                                                       communicator);
      }

      global_dof_index              first; ///< of the owned nodes, in deal.II's numbers
      std::vector<unsigned int>     local_of_owned;
      std::vector<global_dof_index> ghosts; ///< in deal.II's numbers, sorted
      std::vector<unsigned int>     local_of_ghost;
    };
  } // namespace

  struct HexahedralForest::Data
  {
    using Triangulation = dealii::parallel::distributed::Triangulation<3>;

    explicit Data(MPI_Comm communicator) : triangulation(communicator)
    {
    }
    Triangulation                                    triangulation;
    std::vector<Triangulation::active_cell_iterator> own_cells; ///< in the order of cells()
    std::vector<unsigned int>                        bricks;    ///< of coarse cells
  };

  HexahedralForest::HexahedralForest(const HexahedralGrid &grid, MPI_Comm communicator)
    : hexahedral_grid(grid), mpi_communicator(communicator),
      data(std::make_unique<Data>(communicator))
  {
    std::vector<Point<3>>            vertices;
    std::vector<dealii::CellData<3>> cells;
    std::vector<unsigned int> number(std::size_t(grid.planes[0].size()) * grid.planes[1].size()
                                       * grid.planes[2].size(),
                                     HexahedralGrid::none);
    for (unsigned int brick = 0; brick < grid.n_bricks(); ++brick)
      if (grid.filled[brick])
        {
          const auto          i = grid.position(brick);
          dealii::CellData<3> cell;
          for (unsigned int v = 0; v < 8; ++v)
            {
              unsigned int &n
                = number[i[0] + (v & 1)
                         + grid.planes[0].size()
                             * (i[1] + (v >> 1 & 1) + grid.planes[1].size() * (i[2] + (v >> 2)))];
              if (n == HexahedralGrid::none)
                {
                  n = vertices.size();
                  vertices.push_back(grid.corner(brick, v));
                }
              cell.vertices[v] = n;
            }
          cells.push_back(cell);
          data->bricks.push_back(brick);
        }
    data->triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
    list_cells();
  }

  HexahedralForest::~HexahedralForest() = default;

  unsigned long
  HexahedralForest::n_cells() const
  {
    return data->triangulation.n_global_active_cells();
  }

  void
  HexahedralForest::list_cells()
  {
    std::vector<std::pair<dealii::CellId, Data::Triangulation::active_cell_iterator>> order;
    for (const auto &cell : data->triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        order.emplace_back(cell->id(), cell);
    std::sort(order.begin(), order.end(), [](const auto &a, const auto &b) {
      return a.first < b.first;
    });
    data->own_cells.clear();
    cell_list.clear();
    for (const auto &[id, cell] : order)
      {
        // The number in the cell's id is that of p4est's tree, which is another one.
        Data::Triangulation::cell_iterator ancestor = cell;
        while (ancestor->level() > 0)
          ancestor = ancestor->parent();
        HexahedralCell own;
        own.brick = data->bricks[ancestor->index()];
        own.lower = cell->vertex(0);
        own.size  = cell->vertex(7) - cell->vertex(0);
        own.level = cell->level();
        for (unsigned int side = 0; side < 6; ++side)
          if (cell->at_boundary(side))
            own.outer |= 1u << side;
        data->own_cells.push_back(cell);
        cell_list.push_back(own);
      }
  }

  void
  HexahedralForest::refine(const std::vector<bool> &flags)
  {
    for (unsigned int c = 0; c < flags.size(); ++c)
      if (flags[c])
        data->own_cells[c]->set_refine_flag();
    data->triangulation.execute_coarsening_and_refinement();
    list_cells();
  }

  HexahedralSpace
  HexahedralForest::number(const unsigned int degree) const
  {
    const dealii::FE_Q<3> element(degree);
    dealii::DoFHandler<3> dof_handler(data->triangulation);
    dof_handler.distribute_dofs(element);
    const auto         constraints    = hanging_nodes(dof_handler);
    const unsigned int nodes_per_cell = element.n_dofs_per_cell();
    const auto         lexicographic  = element.get_poly_space_numbering_inverse();

    std::vector<global_dof_index> nodes, dofs(nodes_per_cell);
    nodes.reserve(data->own_cells.size() * nodes_per_cell);
    for (const auto &own : data->own_cells)
      {
        const typename dealii::DoFHandler<3>::active_cell_iterator cell(&data->triangulation,
                                                                        own->level(),
                                                                        own->index(),
                                                                        &dof_handler);
        cell->get_dof_indices(dofs);
        for (const unsigned int i : lexicographic)
          nodes.push_back(dofs[i]);
      }
    const Numbering numbering(nodes,
                              dof_handler.locally_owned_dofs(),
                              constraints,
                              mpi_communicator);

    HexahedralSpace space;
    space.degree         = degree;
    space.nodes_per_cell = nodes_per_cell;
    space.n_owned        = numbering.n_owned();
    space.n_local        = numbering.n_local();
    space.n_nodes        = numbering.layout->size() / 3;
    space.layout         = numbering.layout;
    space.hanging_begin.assign(1, 0);
    space.cell_nodes.reserve(nodes.size());
    std::map<global_dof_index, unsigned int> hanging;
    for (const global_dof_index node : nodes)
      {
        if (!constraints.is_constrained(node))
          {
            space.cell_nodes.push_back(numbering.local(node));
            continue;
          }
        const auto [entry, is_new] = hanging.emplace(node, hanging.size());
        space.cell_nodes.push_back(space.n_local + entry->second);
        if (!is_new)
          continue;
        for (const auto &[parent, weight] : *constraints.get_constraint_entries(node))
          {
            space.parents.push_back(numbering.local(parent));
            space.weights.push_back(weight);
          }
        space.hanging_begin.push_back(space.parents.size());
      }
    return space;
  }
} // namespace tetradapt::solve
