// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/recovery/patches.h"

#include "tetradapt/compare/field_evaluator.h"

#include <algorithm>

namespace tetradapt::estimate
{
  using dealii::Point;

  RecoveryPatches::RecoveryPatches(const mesh::TetMesh &mesh)
    : cells(4 * mesh.cells.size()), of_cell(mesh.n_cells())
  {
    const unsigned int        n_points = mesh.n_points();
    std::vector<unsigned int> start(n_points + std::size_t(1), 0);
    for (const auto &cell : mesh.cells)
      for (const unsigned int v : cell)
        ++start[v + 1];
    for (unsigned int v = 0; v < n_points; ++v)
      start[v + 1] += start[v];
    auto next = start;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      for (const unsigned int v : mesh.cells[cell])
        cells[next[v]++] = cell;

    vertex.reserve(n_points);
    begin.reserve(n_points + std::size_t(1));
    first_of_vertex.reserve(n_points + std::size_t(1));
    for (unsigned int v = 0; v < n_points; ++v)
      {
        first_of_vertex.push_back(vertex.size());
        const auto first = cells.begin() + start[v], last = cells.begin() + start[v + 1];
        const auto other_region = [&](const unsigned int a, const unsigned int b) {
          return mesh.regions[a] != mesh.regions[b];
        };
        if (std::adjacent_find(first, last, other_region) != last)
          std::stable_sort(first, last, [&](const unsigned int a, const unsigned int b) {
            return mesh.regions[a] < mesh.regions[b];
          });
        for (auto it = first; it != last; ++it)
          {
            if (it == first || other_region(*it, *(it - 1)))
              {
                vertex.push_back(v);
                begin.push_back(it - cells.begin());
              }
            for (unsigned int i = 0; i < 4; ++i)
              if (mesh.cells[*it][i] == v)
                of_cell[*it][i] = vertex.size() - 1;
          }
      }
    first_of_vertex.push_back(vertex.size());
    begin.push_back(cells.size());
  }

  void
  RecoveryPatches::cells_of(const unsigned int         patch,
                            const unsigned int         layers,
                            std::vector<unsigned int> &result) const
  {
    result.assign(cells.begin() + begin[patch], cells.begin() + begin[patch + 1]);
    std::vector<unsigned int> patches;
    for (unsigned int layer = 0; layer < layers; ++layer)
      {
        patches.clear();
        for (const unsigned int cell : result)
          patches.insert(patches.end(), of_cell[cell].begin(), of_cell[cell].end());
        std::sort(patches.begin(), patches.end());
        patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
        for (const unsigned int p : patches)
          result.insert(result.end(), cells.begin() + begin[p], cells.begin() + begin[p + 1]);
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
      }
  }

  void
  RecoveryPatches::nearest_cells(const mesh::TetMesh       &mesh,
                                 const unsigned int         patch,
                                 const unsigned int         n_cells,
                                 std::vector<unsigned int> &result) const
  {
    cells_of(patch, 0, result);
    const std::vector<unsigned int> own = result;
    for (unsigned int layers = 1; layers <= 2 && result.size() < n_cells; ++layers)
      cells_of(patch, layers, result);
    if (own.size() >= n_cells || result.size() <= n_cells)
      return;
    const Point<3>     &vertex_point = mesh.points[vertex[patch]];
    std::vector<double> distances;
    for (const unsigned int cell : result)
      distances.push_back(
        std::binary_search(own.begin(), own.end(), cell)
          ? 0.
          : compare::position(mesh, cell, {{.25, .25, .25, .25}}).distance_square(vertex_point));
    std::vector<double> sorted = distances;
    std::nth_element(sorted.begin(), sorted.begin() + (n_cells - 1), sorted.end());
    // Equal distances differ by rounding only.
    const double limit = (1. + 1e-9) * sorted[n_cells - 1];
    unsigned int kept  = 0;
    for (unsigned int k = 0; k < result.size(); ++k)
      if (distances[k] <= limit)
        result[kept++] = result[k];
    result.resize(kept);
  }

  unsigned int
  RecoveryPatches::cell_of_face(const mesh::TetMesh &mesh, const unsigned int face) const
  {
    const auto &v = mesh.faces[face].vertices;
    for (unsigned int k = begin[first_of_vertex[v[0]]]; k < begin[first_of_vertex[v[0] + 1]]; ++k)
      {
        const auto &cell = mesh.cells[cells[k]];
        const auto  has  = [&](const unsigned int point) {
          return cell[0] == point || cell[1] == point || cell[2] == point || cell[3] == point;
        };
        if (has(v[1]) && has(v[2]))
          return cells[k];
      }
    return dealii::numbers::invalid_unsigned_int; // not in a finalized mesh
  }
} // namespace tetradapt::estimate
