// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/block_matrix.h"

#include <algorithm>

namespace tetradapt::mechanics
{
  namespace
  {
    /** The cells around each owned node, in compressed rows. */
    struct NodeCells
    {
      explicit NodeCells(const DisplacementSpace &space) : starts(space.n_owned_nodes() + 1, 0)
      {
        const unsigned int n_per_cell = space.n_nodes_per_cell();
        const auto         for_each   = [&](const auto &action) {
          for (const unsigned int cell : space.touching_cells())
            for (unsigned int i = 0; i < n_per_cell; ++i)
              {
                const unsigned int node = space.local_node(space.cell_node(cell, i));
                if (node < space.n_owned_nodes())
                  action(node, cell);
              }
        };
        for_each([&](unsigned int node, unsigned int) { ++starts[node + 1]; });
        for (unsigned int node = 0; node + 1 < starts.size(); ++node)
          starts[node + 1] += starts[node];
        cells.resize(starts.back());
        auto position = starts;
        for_each([&](unsigned int node, unsigned int cell) { cells[position[node]++] = cell; });
      }

      std::vector<std::size_t>  starts;
      std::vector<unsigned int> cells;
    };
  } // namespace

  BlockMatrix::BlockMatrix(const DisplacementSpace &space) : layout(space.vector_layout())
  {
    const NodeCells            around(space);
    std::vector<std::size_t>  &row_starts = entries.begin;
    std::vector<unsigned int> &columns    = entries.columns;
    row_starts.resize(space.n_owned_nodes() + 1);
    const unsigned int        n_per_cell = space.n_nodes_per_cell();
    std::vector<unsigned int> last_row(space.n_local_nodes(),
                                       dealii::numbers::invalid_unsigned_int);
    columns.reserve(static_cast<std::size_t>(space.n_owned_nodes()) * (n_per_cell == 4 ? 15 : 28));
    for (unsigned int row = 0; row < space.n_owned_nodes(); ++row)
      {
        for (std::size_t k = around.starts[row]; k < around.starts[row + 1]; ++k)
          for (unsigned int i = 0; i < n_per_cell; ++i)
            {
              const unsigned int node = space.local_node(space.cell_node(around.cells[k], i));
              if (last_row[node] != row)
                {
                  last_row[node] = row;
                  columns.push_back(node);
                }
            }
        std::sort(columns.begin() + row_starts[row], columns.end());
        row_starts[row + 1] = columns.size();
      }
    entries.blocks.assign(columns.size(), Block{});
  }

  std::size_t
  BlockMatrix::find(unsigned int row, unsigned int column) const
  {
    const auto first = entries.columns.begin();
    return std::lower_bound(first + entries.begin[row], first + entries.begin[row + 1], column)
           - first;
  }

  void
  BlockMatrix::vmult(Vector &destination, const Vector &source) const
  {
    source.update_ghost_values();
    const double *const x = source.begin();
    double *const       y = destination.begin();
    for (unsigned int row = 0; row < n_rows(); ++row)
      {
        double y0 = 0., y1 = 0., y2 = 0.;
        for (std::size_t k = entries.begin[row]; k < entries.begin[row + 1]; ++k)
          {
            const Block        &b = entries.blocks[k];
            const double *const v = x + 3 * static_cast<std::size_t>(entries.columns[k]);
            y0 += b[0] * v[0] + b[1] * v[1] + b[2] * v[2];
            y1 += b[3] * v[0] + b[4] * v[1] + b[5] * v[2];
            y2 += b[6] * v[0] + b[7] * v[1] + b[8] * v[2];
          }
        y[3 * row]     = y0;
        y[3 * row + 1] = y1;
        y[3 * row + 2] = y2;
      }
    source.zero_out_ghost_values();
  }
} // namespace tetradapt::mechanics
