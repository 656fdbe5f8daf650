// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_row_builder_h
#define tetradapt_source_solve_row_builder_h

#include "tetradapt/core/clones.h"
#include "tetradapt/solve/block_rows.h"

namespace tetradapt::solve
{
  /** Appends rows to a BlockRows, adding up what falls on the same column. */
  template <unsigned int n, unsigned int m>
  class RowBuilder
  {
  public:
    RowBuilder(BlockRows<n, m> &rows, unsigned int n_columns)
      : rows(rows), position(n_columns, ~std::size_t(0))
    {
    }
    /** The block of the present row in @p column, zero when first asked for. */
    TETRADAPT_INLINE typename BlockRows<n, m>::Block &
    block(unsigned int column)
    {
      const std::size_t k = position[column];
      return k < rows.columns.size() && k >= rows.begin.back() ? rows.blocks[k] : append(column);
    }
    void
    end_row()
    {
      rows.begin.push_back(rows.columns.size());
    }

  private:
    typename BlockRows<n, m>::Block &
    append(unsigned int column)
    {
      position[column] = rows.columns.size();
      rows.columns.push_back(column);
      rows.blocks.emplace_back();
      rows.blocks.back().fill(0.);
      return rows.blocks.back();
    }

    BlockRows<n, m>         &rows;
    std::vector<std::size_t> position;
  };
} // namespace tetradapt::solve

#endif
