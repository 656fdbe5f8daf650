// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/extrapolation.h"

namespace tetradapt::estimate
{
  EstimatorTraits
  ExtrapolationRen::traits() const
  {
    EstimatorTraits traits;
    traits.name            = "extrapolation ren";
    traits.documentation   = "Relative error norm of every node against a reference solution, "
                             "|P-Q|/|P0-Q|, summed over the nodes of a cell. A displacement error: "
                             "it shows where an error is felt, not where it is made, and refining "
                             "by it need not converge.";
    traits.needs_reference = true;
    traits.is_energy_norm  = false;
    return traits;
  }

  Estimate
  ExtrapolationRen::estimate(const EstimateInput &input) const
  {
    // Where there is no reference the exact displacement takes its place.
    const compare::NodalRen &ren = input.comparison.has_reference()
                                     ? input.comparison.ren_to_reference()
                                     : input.comparison.ren();
    return {ren.cell_sums, ren.mean};
  }
} // namespace tetradapt::estimate
