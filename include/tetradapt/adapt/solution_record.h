// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_solution_record_h
#define tetradapt_adapt_solution_record_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/solve/static_solution.h"

#include <string>

namespace tetradapt::adapt
{
  /**
   * Fills record.regions and record.equilibrium for a cycle's solution. Collective.
   * @return empty, or a sentence that warns of reactions that do not balance the loads.
   */
  std::string
  describe_solution(const solve::StaticSystem    &system,
                    const solve::StaticSolution  &solution,
                    const mechanics::MaterialMap &materials,
                    CycleRecord                  &record);
} // namespace tetradapt::adapt

#endif
