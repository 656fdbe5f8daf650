// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/pressure_field.h"

#include <map>
#include <numeric>

namespace tetradapt::mesh
{
  PressureNodes::PressureNodes(const TetMesh &mesh)
    : cell_nodes(mesh.n_cells()), vertices(mesh.n_points())
  {
    std::iota(vertices.begin(), vertices.end(), 0u);
    std::vector<int>                                     first(mesh.n_points());
    std::vector<char>                                    met(mesh.n_points(), 0);
    std::map<std::pair<unsigned int, int>, unsigned int> further;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      for (unsigned int i = 0; i < 4; ++i)
        {
          const unsigned int vertex = mesh.cells[cell][i];
          const int          region = mesh.regions[cell];
          unsigned int       node   = vertex;
          if (met[vertex] == 0)
            {
              met[vertex]   = 1;
              first[vertex] = region;
            }
          else if (first[vertex] != region)
            {
              const auto found = further.emplace(std::make_pair(vertex, region), vertices.size());
              if (found.second)
                vertices.push_back(vertex);
              node = found.first->second;
            }
          cell_nodes[cell][i] = node;
        }
  }

  PressureField::PressureField(const TetMesh &mesh)
    : PressureField(std::make_shared<const PressureNodes>(mesh))
  {
  }

  PressureField::PressureField(std::shared_ptr<const PressureNodes> shared_nodes)
    : nodes(std::move(shared_nodes)), values(nodes->size(), 0.)
  {
  }
} // namespace tetradapt::mesh
