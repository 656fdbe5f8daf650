// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_block_rows_h
#define tetradapt_solve_block_rows_h

#include "tetradapt/mechanics/block_matrix.h"

namespace tetradapt::solve
{
  using mechanics::BlockRows;

  /**
   * A square matrix of n x n blocks for products: columns of blocks are stored one after
   * the other. Columns are local nodes of its layout.
   */
  template <typename Number, unsigned int n>
  class BlockOperator : public mechanics::LinearOperator<Number>
  {
  public:
    using Layout = std::shared_ptr<const dealii::Utilities::MPI::Partitioner>;

    /** Copies @p rows, which are those of the owned nodes, times @p scale. */
    BlockOperator(const BlockRows<n, n> &rows, const Layout &layout, double scale = 1.);

    void
    vmult(mechanics::VectorOf<Number>       &destination,
          const mechanics::VectorOf<Number> &source) const override;

    const Layout &
    vector_layout() const override
    {
      return layout;
    }

    /** The blocks on the diagonal, row by row. */
    std::vector<std::array<Number, n * n>>
    diagonal_blocks() const;

  private:
    static constexpr unsigned int padded = n == 3 ? 4 : 8;

    Layout                    layout;
    std::vector<std::size_t>  begin;
    std::vector<unsigned int> columns;
    std::vector<Number>       blocks; ///< column by column, then what fills a register
  };
} // namespace tetradapt::solve

#endif
