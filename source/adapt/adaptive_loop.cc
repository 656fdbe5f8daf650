// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/adaptive_loop.h"

namespace tetradapt::adapt
{
  StopDecision
  AdaptiveLoop::run_cycles()
  {
    for (unsigned int cycle = 0;; ++cycle)
      {
        solve(cycle);
        estimate();
        StopDecision decision = decide();
        if (!decision.stop())
          decision = mark();
        if (!decision.stop())
          decision = refine();
        if (decision.stop())
          return decision;
      }
  }

  void
  AdaptiveLoop::expect_error(const double error)
  {
    expected_error = error;
  }

  double
  AdaptiveLoop::solver_error(const double fraction) const
  {
    return fraction * expected_error;
  }
} // namespace tetradapt::adapt
