// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_material_history_h
#define tetradapt_mechanics_material_history_h

#include "tetradapt/laws/constitutive_law.h"

#include <cstddef>
#include <vector>

namespace tetradapt::mechanics
{
  /**
   * The numbers that laws remember at the quadrature points of cells, before and after a step,
   * all zero at the beginning. Flat: cells may have different laws, and those that remember
   * nothing take no memory.
   */
  class MaterialHistory
  {
  public:
    /** @param sizes how many numbers a point of each cell has. */
    MaterialHistory(const std::vector<unsigned int> &sizes, unsigned int points_per_cell);

    /** The history of point @p q of cell @p k. Valid while this object lives. */
    laws::History
    at(std::size_t k, unsigned int q);

    /** Makes what was written last the state before the next step. */
    void
    accept();

  private:
    unsigned int             points_per_cell;
    std::vector<std::size_t> begin; ///< of cells
    std::vector<double>      before, after;
  };
} // namespace tetradapt::mechanics

#endif
