// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/calibrated_error.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    constexpr double slowest_rate = 0.25; ///< s of errors N^-s, at strong singularities
  }

  std::optional<double>
  calibrated_error(const std::vector<NestedSolution> &levels)
  {
    const std::size_t n = levels.size();
    if (n < 3)
      return std::nullopt;
    const NestedSolution &last   = levels.back();
    double                factor = 0., largest = 0.; // of squares
    for (std::size_t steps = 1; steps <= std::min<std::size_t>(5, n - 1); ++steps)
      {
        const NestedSolution &before = levels[n - 1 - steps];
        const double          gained = last.gain - before.gain;
        const double          decrease
          = before.indicator * before.indicator - last.indicator * last.indicator;
        if (decrease > 0.)
          factor = std::max(factor, gained / decrease);
        largest = std::max(
          largest, gained / std::expm1(2. * slowest_rate * std::log(last.n_dofs / before.n_dofs)));
      }
    if (!(largest > 0.))
      return std::nullopt;
    const double limit = std::sqrt(largest);
    return factor > 0. ? std::min(std::sqrt(factor) * last.indicator, limit) : limit;
  }
} // namespace tetradapt::estimate
