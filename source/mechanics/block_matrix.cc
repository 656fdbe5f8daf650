// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/block_matrix.h"

namespace tetradapt::mechanics
{
  namespace
  {
    constexpr unsigned int invalid = dealii::numbers::invalid_unsigned_int;

    /** The local nodes of the space's cells, and of each owned node where it is among them. */
    struct CellNodes
    {
      explicit CellNodes(const fem::Space &space)
        : n_per_cell(space.n_nodes_per_cell()), starts(space.n_owned_nodes() + 1, 0)
      {
        nodes.reserve(std::size_t(n_per_cell) * space.touching_cells().size());
        for (const unsigned int cell : space.touching_cells())
          for (unsigned int i = 0; i < n_per_cell; ++i)
            nodes.push_back(space.local_node(space.cell_node(cell, i)));
        for (const unsigned int node : nodes)
          if (node < space.n_owned_nodes())
            ++starts[node + 1];
        for (unsigned int node = 0; node + 1 < starts.size(); ++node)
          starts[node + 1] += starts[node];
        positions.resize(starts.back());
        auto next = starts;
        for (std::size_t k = 0; k < nodes.size(); ++k)
          if (nodes[k] < space.n_owned_nodes())
            positions[next[nodes[k]]++] = k;
      }

      unsigned int              n_per_cell;
      std::vector<unsigned int> nodes;
      std::vector<std::size_t>  starts, positions;
    };
  } // namespace

  BlockMatrix::BlockMatrix(const fem::Space &space, std::vector<unsigned int> *cell_entries)
    : layout(space.vector_layout())
  {
    const CellNodes            around(space);
    const unsigned int         n       = around.n_per_cell;
    std::vector<unsigned int> &columns = entries.columns;
    // Where the present row has a column; less than its beginning: it has not.
    std::vector<std::size_t> where(space.n_local_nodes(), ~std::size_t(0));
    columns.reserve(static_cast<std::size_t>(space.n_owned_nodes()) * (n == 4 ? 15 : 28));
    entries.begin.reserve(space.n_owned_nodes() + 1);
    if (cell_entries != nullptr)
      cell_entries->assign(n * around.nodes.size(), invalid);
    for (unsigned int row = 0; row < space.n_owned_nodes(); ++row)
      {
        const std::size_t first = columns.size();
        where[row]              = first;
        columns.push_back(row);
        for (std::size_t p = around.starts[row]; p < around.starts[row + 1]; ++p)
          {
            const std::size_t   k     = around.positions[p];
            const unsigned int *nodes = around.nodes.data() + k / n * n;
            for (unsigned int i = 0; i < n; ++i)
              {
                std::size_t &entry = where[nodes[i]];
                if (entry < first || entry == ~std::size_t(0))
                  {
                    entry = columns.size();
                    columns.push_back(nodes[i]);
                  }
                if (cell_entries != nullptr)
                  (*cell_entries)[n * k + i] = entry;
              }
          }
        entries.begin.push_back(columns.size());
      }
    entries.blocks.assign(columns.size(), Block{});
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
