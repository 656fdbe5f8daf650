// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/block_rows.h"

#include "tetradapt/core/clones.h"

namespace tetradapt::solve
{
  namespace
  {
    /** y = A x; blocks of n columns. Each is read with what follows it, @p padded numbers
     * in all: what the others make is left aside. */
    template <typename Number, unsigned int n, unsigned int padded>
    TETRADAPT_INLINE void
    multiply(std::size_t         n_rows,
             const std::size_t  *begin,
             const unsigned int *columns,
             const Number *__restrict blocks,
             const Number *__restrict x,
             Number *__restrict y)
    {
      for (std::size_t row = 0; row < n_rows; ++row)
        {
          Number even[padded] = {}, odd[padded] = {};
          for (std::size_t k = begin[row]; k < begin[row + 1]; ++k)
            {
              const Number *block = blocks + n * n * k;
              const Number *from  = x + n * std::size_t(columns[k]);
#pragma GCC unroll 6
              for (unsigned int j = 0; j < n; ++j)
#pragma GCC unroll 8
                for (unsigned int i = 0; i < padded; ++i)
                  (j % 2 == 0 ? even : odd)[i] += block[n * j + i] * from[j];
            }
          for (unsigned int i = 0; i < n; ++i)
            y[n * row + i] = even[i] + odd[i];
        }
    }

// Clones cannot be made of templates.
#define TETRADAPT_MULTIPLY(Number, n, padded)                                                      \
  TETRADAPT_CLONES void multiply_blocks(std::integral_constant<unsigned int, n>,                   \
                                        std::size_t         n_rows,                                \
                                        const std::size_t  *begin,                                 \
                                        const unsigned int *columns,                               \
                                        const Number       *blocks,                                \
                                        const Number       *x,                                     \
                                        Number             *y)                                     \
  {                                                                                                \
    multiply<Number, n, padded>(n_rows, begin, columns, blocks, x, y);                             \
  }
    TETRADAPT_MULTIPLY(float, 3, 4)
    TETRADAPT_MULTIPLY(float, 6, 8)
    TETRADAPT_MULTIPLY(double, 3, 4)
    TETRADAPT_MULTIPLY(double, 6, 8)
  } // namespace

  template <typename Number, unsigned int n>
  BlockOperator<Number, n>::BlockOperator(const BlockRows<n, n> &rows,
                                          const Layout          &layout,
                                          const double           scale)
    : layout(layout), begin(rows.begin), columns(rows.columns)
  {
    blocks.resize(n * n * rows.blocks.size() + padded - n, Number(0));
    for (std::size_t k = 0; k < rows.blocks.size(); ++k)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          blocks[n * (n * k + j) + i] = static_cast<Number>(scale * rows.blocks[k][n * i + j]);
  }

  template <typename Number, unsigned int n>
  void
  BlockOperator<Number, n>::vmult(mechanics::VectorOf<Number>       &destination,
                                  const mechanics::VectorOf<Number> &source) const
  {
    source.update_ghost_values();
    if (!columns.empty())
      multiply_blocks(std::integral_constant<unsigned int, n>(),
                      begin.size() - 1,
                      begin.data(),
                      columns.data(),
                      blocks.data(),
                      source.begin(),
                      destination.begin());
    source.zero_out_ghost_values();
  }

  template <typename Number, unsigned int n>
  std::vector<std::array<Number, n * n>>
  BlockOperator<Number, n>::diagonal_blocks() const
  {
    std::vector<std::array<Number, n * n>> diagonal(begin.size() - 1);
    for (unsigned int row = 0; row < diagonal.size(); ++row)
      {
        diagonal[row].fill(0);
        for (std::size_t k = begin[row]; k < begin[row + 1]; ++k)
          if (columns[k] == row)
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                diagonal[row][n * i + j] = blocks[n * (n * k + j) + i];
      }
    return diagonal;
  }

  template class BlockOperator<float, 3>;
  template class BlockOperator<float, 6>;
  template class BlockOperator<double, 3>;
  template class BlockOperator<double, 6>;
} // namespace tetradapt::solve
