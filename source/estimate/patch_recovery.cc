// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/flux_projection.h"
#include "tetradapt/estimate/recovery/recovery.h"

namespace tetradapt::estimate
{
  EstimatorTraits
  PatchRecovery::traits() const
  {
    EstimatorTraits traits;
    traits.name = "spr";
    traits.documentation
      = "Energy norm of the difference between the stress and one recovered by "
        "superconvergent patch recovery (Zienkiewicz and Zhu 1992), one-sided at "
        "interfaces of regions, that fits tractions, supports and equilibrium. "
        "Close to the error where the solution is smooth; no bound.";
    return traits;
  }

  Estimate
  PatchRecovery::estimate(const EstimateInput &input) const
  {
    auto recovery = recovery_estimate(input.comparison.displacement(),
                                      input.comparison.material_map(),
                                      input.comparison.mpi_communicator(),
                                      &input.scene);
    return {std::move(recovery.cell_energy), recovery.global};
  }
} // namespace tetradapt::estimate
