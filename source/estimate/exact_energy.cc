// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/extrapolation.h"

namespace tetradapt::estimate
{
  EstimatorTraits
  ExactEnergy::traits() const
  {
    EstimatorTraits traits;
    traits.name          = "exact energy";
    traits.documentation = "Energy norm of the true error, for scenes that give the exact "
                           "displacement.";
    traits.needs_exact_displacement = true;
    return traits;
  }

  Estimate
  ExactEnergy::estimate(const EstimateInput &input) const
  {
    const compare::Difference &difference = input.comparison.to_exact_solution();
    return {difference.cell_energy, difference.energy};
  }
} // namespace tetradapt::estimate
