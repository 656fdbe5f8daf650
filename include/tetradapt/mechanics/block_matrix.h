// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_block_matrix_h
#define tetradapt_mechanics_block_matrix_h

#include "tetradapt/mechanics/linear_operator.h"

namespace tetradapt::mechanics
{
  /**
   * A sparse matrix of 3x3 blocks on the nodes of a DisplacementSpace: complete
   * rows for the owned nodes, columns in local numbering (owned nodes, then
   * ghosts). One index a block instead of nine keeps the product with a vector
   * bound by the values alone.
   */
  class BlockMatrix : public LinearOperator<double>
  {
  public:
    using Block = std::array<double, 9>; ///< row by row

    /** The pattern of the space's couplings, all values zero. */
    explicit BlockMatrix(const DisplacementSpace &space);

    unsigned int
    n_rows() const
    {
      return row_starts.size() - 1;
    }
    std::size_t
    n_blocks() const
    {
      return columns.size();
    }
    std::size_t
    row_begin(unsigned int row) const
    {
      return row_starts[row];
    }
    std::size_t
    row_end(unsigned int row) const
    {
      return row_starts[row + 1];
    }
    unsigned int
    column(std::size_t entry) const
    {
      return columns[entry];
    }
    Block &
    block(std::size_t entry)
    {
      return blocks[entry];
    }
    const Block &
    block(std::size_t entry) const
    {
      return blocks[entry];
    }
    /** Where row @p row keeps column @p column, which must be in the pattern. */
    std::size_t
    find(unsigned int row, unsigned int column) const;

    void
    vmult(Vector &destination, const Vector &source) const override;

    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_layout() const override
    {
      return layout;
    }

  private:
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<std::size_t>                                   row_starts;
    std::vector<unsigned int>                                  columns; ///< sorted in each row
    std::vector<Block>                                         blocks;
  };
} // namespace tetradapt::mechanics

#endif
