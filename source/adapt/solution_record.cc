// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/solution_record.h"

#include <sstream>

namespace tetradapt::adapt
{
  std::string
  describe_solution(const solve::StaticSystem    &system,
                    const solve::StaticSolution  &solution,
                    const mechanics::MaterialMap &materials,
                    CycleRecord                  &record)
  {
    record.regions     = mechanics::compute_region_figures(*solution.displacement, materials);
    record.equilibrium = system.equilibrium(solution, record.regions);
    const solve::Equilibrium &equilibrium = *record.equilibrium;
    if (equilibrium.is_balanced())
      return "";
    std::ostringstream text;
    text.precision(2);
    text << "Cycle " << record.cycle << ": reactions and loads do not balance. Their sum is "
         << equilibrium.relative_imbalance << " of all forces, more than the "
         << equilibrium.allowed_imbalance
         << " allowed: that much of the reactions was left by the solver. Make Solver/Tolerance "
            "smaller, or set Solver/Type = direct.";
    return text.str();
  }
} // namespace tetradapt::adapt
