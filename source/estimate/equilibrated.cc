// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/equilibrated.h"

#include "tetradapt/estimate/equilibrated_bound.h"

namespace tetradapt::estimate
{
  EstimatorTraits
  Equilibrated::traits() const
  {
    EstimatorTraits traits;
    traits.name          = "equilibrated";
    traits.documentation = "Distance of the stress to one that is in equilibrium with the loads at "
                           "every point (Prager and Synge, 1947). A bound of the energy norm of "
                           "the error without any unknown constant.";
    return traits;
  }



  Estimate
  Equilibrated::estimate(const EstimateInput &input) const
  {
    EquilibratedBound bound = equilibrated_bound(input.comparison.displacement(),
                                                 input.scene,
                                                 input.comparison.material_map(),
                                                 input.comparison.mpi_communicator());
    return {std::move(bound.cell_energy), bound.global};
  }
} // namespace tetradapt::estimate
