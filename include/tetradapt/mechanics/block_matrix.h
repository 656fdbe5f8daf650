// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_block_matrix_h
#define tetradapt_mechanics_block_matrix_h

#include "tetradapt/mechanics/linear_operator.h"

#include <array>
#include <vector>

namespace tetradapt::mechanics
{
  /** A sparse matrix of n x m blocks in compressed rows; blocks are stored row by row. */
  template <unsigned int n, unsigned int m>
  struct BlockRows
  {
    using Block = std::array<double, n * m>;

    std::vector<std::size_t>  begin{0}; ///< one more than rows
    std::vector<unsigned int> columns;
    std::vector<Block>        blocks;

    unsigned int
    n_rows() const
    {
      return begin.size() - 1;
    }
  };

  /**
   * A sparse matrix of 3x3 blocks on the nodes of a fem::Space: complete
   * rows for the owned nodes, columns in local numbering (owned nodes, then
   * ghosts). One index a block instead of nine keeps the product with a vector
   * bound by the values alone.
   */
  class BlockMatrix : public LinearOperator<double>
  {
  public:
    using Block = BlockRows<3, 3>::Block;

    /** The pattern of the space's couplings, all values zero.
     * @param cell_entries if not null, gets where the blocks of cells go: that of nodes i and
     *        j of the k-th of the space's touching cells, which have n nodes each, to entry
     *        (*cell_entries)[(k n + i) n + j]; numbers::invalid_unsigned_int if i is a ghost. */
    explicit BlockMatrix(const fem::Space          &space,
                         std::vector<unsigned int> *cell_entries = nullptr);

    unsigned int
    n_rows() const
    {
      return entries.n_rows();
    }
    std::size_t
    n_blocks() const
    {
      return entries.columns.size();
    }
    /** The first entry of a row, which is its own block. */
    std::size_t
    row_begin(unsigned int row) const
    {
      return entries.begin[row];
    }
    std::size_t
    row_end(unsigned int row) const
    {
      return entries.begin[row + 1];
    }
    unsigned int
    column(std::size_t entry) const
    {
      return entries.columns[entry];
    }
    Block &
    block(std::size_t entry)
    {
      return entries.blocks[entry];
    }
    const Block &
    block(std::size_t entry) const
    {
      return entries.blocks[entry];
    }
    /** All of it. */
    const BlockRows<3, 3> &
    rows() const
    {
      return entries;
    }
    void
    vmult(Vector &destination, const Vector &source) const override;

    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_layout() const override
    {
      return layout;
    }

  private:
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    BlockRows<3, 3>                                            entries;
  };
} // namespace tetradapt::mechanics

#endif
