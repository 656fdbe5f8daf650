// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_blocks_h
#define tetradapt_mesh_blocks_h

#include "tetradapt/mesh/plc.h"

namespace tetradapt::mesh
{
  /**
   * A body made of axis-parallel boxes ("blocks"), on the tensor grid of all their
   * coordinates: every cell of the grid belongs to one block or to none. Coordinates
   * that differ by less than 1e-9 of the body's extent are taken for the same.
   */
  class BlockGrid
  {
  public:
    /** A cell that belongs to no block. */
    static constexpr unsigned int outside = dealii::numbers::invalid_unsigned_int;

    /**
     * @param blocks lower and upper corner of each.
     * @throws core::InputError "Mesh/Blocks: ..." if there is none, corners are not
     *         finite, a block has no extent, two overlap, coordinates are closer than
     *         1e-4 of the extent (TetGen may not come to an end), the grid is too large,
     *         or blocks touch along an edge or in a point without a common face there,
     *         which leaves the surface without an inside next to it.
     */
    explicit BlockGrid(const std::vector<std::pair<Point<3>, Point<3>>> &blocks);

    /** Number of cells along axis @p d. */
    int
    size(unsigned int d) const
    {
      return static_cast<int>(coordinates[d].size()) - 1;
    }

    /** The block of a cell, numbers counted along the axes from 0; outside for any
     * numbers beyond the grid. */
    unsigned int
    block(int i, int j, int k) const
    {
      return i < 0 || j < 0 || k < 0 || i >= size(0) || j >= size(1) || k >= size(2)
               ? outside
               : cells[i + std::size_t(size(0)) * (j + std::size_t(size(1)) * k)];
    }

    unsigned int
    n_blocks() const
    {
      return block_count;
    }

    /** The planes of the grid along each axis, increasing. */
    std::array<std::vector<double>, 3> coordinates;

  private:
    std::vector<unsigned int> cells; ///< block of each, along x first
    unsigned int              block_count;
  };

  /**
   * The boundary of the body and the faces between blocks of different regions, as
   * rectangles of the grid. Boundary ids and names are those of a box, by the
   * direction of the outer normal.
   *
   * @param regions region id of each block; empty: 0 for all.
   */
  PiecewiseLinearComplex
  blocks_complex(const BlockGrid &grid, const std::vector<int> &regions);
} // namespace tetradapt::mesh

#endif
