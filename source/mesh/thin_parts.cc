// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/thin_parts.h"

#include <algorithm>

namespace tetradapt::mesh
{
  namespace
  {
    /** Edges from a deep point to the farthest corner of a wall that belongs to it: two in
     * each direction, if no edge goes aslant. */
    constexpr unsigned int reach = 6;

    /** Marks the points of all cells that have a marked one. */
    std::vector<char>
    with_neighbours(const TetMesh &mesh, const std::vector<char> &marked)
    {
      std::vector<char> result = marked;
      for (const auto &cell : mesh.cells)
        if (std::any_of(cell.begin(), cell.end(), [&](const unsigned int v) {
              return marked[v] != 0;
            }))
          for (const unsigned int v : cell)
            result[v] = 1;
      return result;
    }
  } // namespace

  std::vector<bool>
  thin_parts(const TetMesh &mesh)
  {
    std::vector<char> near_wall(mesh.n_points(), 0);
    for (const BoundaryFace &face : mesh.faces)
      for (const unsigned int v : face.vertices)
        near_wall[v] = 1;
    near_wall = with_neighbours(mesh, near_wall);

    std::vector<char> thick(mesh.n_points());
    for (unsigned int v = 0; v < mesh.n_points(); ++v)
      thick[v] = near_wall[v] == 0 ? 1 : 0;
    if (std::find(thick.begin(), thick.end(), 1) != thick.end())
      for (unsigned int step = 0; step < reach; ++step)
        thick = with_neighbours(mesh, thick);

    std::vector<bool> thin(mesh.n_cells());
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      thin[cell] = std::any_of(mesh.cells[cell].begin(),
                               mesh.cells[cell].end(),
                               [&](const unsigned int v) { return thick[v] == 0; });
    return thin;
  }
} // namespace tetradapt::mesh
