// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_forest.h"

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    constexpr unsigned int none = HexahedralGrid::none;
  }

  HexahedralForest::HexahedralForest(const HexahedralGrid &grid, MPI_Comm communicator)
    : hexahedral_grid(grid), hexahedra(communicator)
  {
    std::vector<Point<3>>            vertices;
    std::vector<dealii::CellData<3>> cells;
    std::vector<unsigned int>        bricks; // of cells
    std::vector<unsigned int> number(std::size_t(grid.planes[0].size()) * grid.planes[1].size()
                                       * grid.planes[2].size(),
                                     none);
    for (unsigned int brick = 0; brick < grid.n_bricks(); ++brick)
      if (grid.filled[brick])
        {
          const auto          i = grid.position(brick);
          dealii::CellData<3> cell;
          cell.material_id = grid.regions[brick];
          for (unsigned int v = 0; v < 8; ++v)
            {
              unsigned int &n
                = number[i[0] + (v & 1)
                         + grid.planes[0].size()
                             * (i[1] + (v >> 1 & 1) + grid.planes[1].size() * (i[2] + (v >> 2)))];
              if (n == none)
                {
                  n = vertices.size();
                  vertices.push_back(grid.corner(brick, v));
                }
              cell.vertices[v] = n;
            }
          cells.push_back(cell);
          bricks.push_back(brick);
        }
    hexahedra.create_triangulation(vertices, cells, dealii::SubCellData());
    // Every rank has all bricks; what is cut from their sides inherits the ids.
    for (const auto &cell : hexahedra.active_cell_iterators())
      for (unsigned int side = 0; side < 6; ++side)
        if (cell->at_boundary(side))
          cell->face(side)->set_boundary_id(grid.sides[bricks[cell->index()]][side] + 1);
    list_cells();
  }

  void
  HexahedralForest::list_cells()
  {
    iterators.clear();
    for (const auto &cell : hexahedra.active_cell_iterators())
      if (cell->is_locally_owned())
        iterators.push_back(cell);
    std::sort(iterators.begin(), iterators.end(), [](const auto &a, const auto &b) {
      return a->id() < b->id();
    });
    cell_list.clear();
    for (const auto &cell : iterators)
      {
        HexahedralCell own;
        own.lower  = cell->vertex(0);
        own.size   = cell->vertex(7) - cell->vertex(0);
        own.region = static_cast<int>(cell->material_id());
        own.level  = cell->level();
        for (unsigned int side = 0; side < 6; ++side)
          own.patches[side] = cell->at_boundary(side) ? cell->face(side)->boundary_id() - 1 : none;
        cell_list.push_back(own);
      }
  }

  void
  HexahedralForest::refine(const std::vector<bool> &flags)
  {
    for (unsigned int c = 0; c < flags.size(); ++c)
      if (flags[c])
        iterators[c]->set_refine_flag();
    hexahedra.execute_coarsening_and_refinement();
    list_cells();
  }
} // namespace tetradapt::solve
