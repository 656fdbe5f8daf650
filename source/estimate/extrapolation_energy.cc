// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/extrapolation.h"

namespace tetradapt::estimate
{
  EstimatorTraits
  ExtrapolationEnergy::traits() const
  {
    EstimatorTraits traits;
    traits.name          = "extrapolation energy";
    traits.documentation = "Energy norm of the difference to a reference solution on a finer mesh "
                           "or of higher degree, integrated on the reference mesh and gathered per "
                           "cell.";
    traits.needs_reference = true;
    return traits;
  }

  Estimate
  ExtrapolationEnergy::estimate(const EstimateInput &input) const
  {
    const compare::Difference &difference = input.comparison.to_reference();
    return {difference.cell_energy, difference.energy};
  }
} // namespace tetradapt::estimate
