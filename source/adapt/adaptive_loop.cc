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
} // namespace tetradapt::adapt
