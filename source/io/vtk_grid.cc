// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/vtk_grid.h"

#include "tetradapt/io/file_scanner.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::io
{
  namespace
  {
    std::string
    first_of(const std::vector<std::string> &wanted, const std::vector<std::string> &names)
    {
      for (const std::string &candidate : wanted)
        for (const std::string &name : names)
          if (lower_case(name) == candidate)
            return name;
      return "";
    }



    /** Number of nodes of a cell type; 0: any, and the cell is left out. */
    unsigned int
    n_nodes_of_type(const std::int64_t type, const std::size_t cell, const MeshBuilder::Fail &fail)
    {
      switch (type)
        {
        case 0:  // empty
        case 1:  // vertex
        case 2:  // poly vertex
        case 3:  // line
        case 4:  // poly line
        case 21: // quadratic edge
          return 0;
        case vtk_triangle:
          return 3;
        case vtk_tetra:
          return 4;
        case vtk_quadratic_triangle:
          return 6;
        case vtk_quadratic_tetra:
          return 10;
        default:
          fail("cell " + std::to_string(cell) + " (counted from 0) has the VTK type "
               + std::to_string(type)
               + "; only tetrahedra (10, 24) and triangles (5, 22) can be used.");
          return 0;
        }
    }



    int
    id_of(const std::vector<double> &ids, const std::size_t cell, const MeshBuilder::Fail &fail)
    {
      if (ids.empty())
        return 0;
      const double id = ids[cell];
      if (!(std::abs(id) < 2147483648.) || id != std::floor(id))
        fail("cell " + std::to_string(cell) + " (counted from 0) has the region or boundary id "
             + std::to_string(id) + ", which is not a whole number.");
      return static_cast<int>(id);
    }



    void
    check_lengths(const VtkGrid &grid, const MeshBuilder::Fail &fail)
    {
      const std::size_t n_cells = grid.types.size();
      if (grid.ends.size() != n_cells)
        fail("the grid has " + std::to_string(n_cells) + " cell types but "
             + std::to_string(grid.ends.size()) + " cells.");
      for (const auto *ids : {&grid.regions, &grid.boundary_ids})
        if (!ids->empty() && ids->size() != n_cells)
          fail("the grid has " + std::to_string(n_cells) + " cells but "
               + std::to_string(ids->size()) + " region or boundary ids.");
    }
  } // namespace



  std::pair<std::string, std::string>
  id_arrays(const std::vector<std::string> &names)
  {
    return {first_of({"region",
                      "regions",
                      "materialids",
                      "materialid",
                      "material",
                      "gmsh:physical",
                      "cellentityids",
                      "medit:ref",
                      "elementblockids"},
                     names),
            first_of({"boundary_id", "boundary_ids", "boundaryids", "boundary", "patch"}, names)};
  }



  mesh::TetMesh
  mesh_of_grid(VtkGrid &&grid, const MeshBuilder::Fail &fail)
  {
    check_lengths(grid, fail);
    MeshBuilder builder(fail);
    builder.points()         = std::move(grid.points);
    const auto &boundary_ids = grid.boundary_ids.empty() ? grid.regions : grid.boundary_ids;

    std::int64_t begin = 0;
    for (std::size_t c = 0; c < grid.types.size(); ++c)
      {
        const std::int64_t end = grid.ends[c];
        if (end < begin || end > static_cast<std::int64_t>(grid.connectivity.size()))
          fail("the nodes of cell " + std::to_string(c) + " (counted from 0) end at "
               + std::to_string(end) + " in a list of " + std::to_string(grid.connectivity.size())
               + ".");
        const unsigned int n_nodes = n_nodes_of_type(grid.types[c], c, fail);
        if (n_nodes != 0)
          {
            if (end - begin != n_nodes)
              fail("cell " + std::to_string(c) + " (counted from 0) of VTK type "
                   + std::to_string(grid.types[c]) + " has " + std::to_string(end - begin)
                   + " nodes instead of " + std::to_string(n_nodes) + ".");
            std::array<unsigned int, 10> nodes{};
            for (unsigned int i = 0; i < n_nodes; ++i)
              {
                const std::int64_t node = grid.connectivity[begin + i];
                if (node < 0 || node >= static_cast<std::int64_t>(builder.points().size()))
                  fail("cell " + std::to_string(c) + " (counted from 0) names point "
                       + std::to_string(node) + ", but there are "
                       + std::to_string(builder.points().size()) + " points.");
                nodes[i] = node;
              }
            if (n_nodes == 4)
              builder.add_cell({{nodes[0], nodes[1], nodes[2], nodes[3]}},
                               id_of(grid.regions, c, fail));
            else if (n_nodes == 10)
              builder.add_quadratic_cell(nodes, id_of(grid.regions, c, fail));
            else
              builder.add_face({{nodes[0], nodes[1], nodes[2]}}, id_of(boundary_ids, c, fail));
          }
        begin = end;
      }
    return builder.take();
  }
} // namespace tetradapt::io
