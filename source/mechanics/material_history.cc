// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/material_history.h"

namespace tetradapt::mechanics
{
  MaterialHistory::MaterialHistory(const std::vector<unsigned int> &sizes,
                                   const unsigned int               points_per_cell)
    : points_per_cell(points_per_cell), begin(sizes.size() + 1, 0)
  {
    for (std::size_t k = 0; k < sizes.size(); ++k)
      begin[k + 1] = begin[k] + std::size_t(sizes[k]) * points_per_cell;
    before.assign(begin.back(), 0.);
    after = before;
  }

  laws::History
  MaterialHistory::at(const std::size_t k, const unsigned int q)
  {
    const std::size_t size = (begin[k + 1] - begin[k]) / points_per_cell;
    if (size == 0)
      return {};
    const std::size_t place = begin[k] + q * size;
    return {&before[place], &after[place]};
  }

  void
  MaterialHistory::accept()
  {
    before = after;
  }
} // namespace tetradapt::mechanics
