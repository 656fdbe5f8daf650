// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  std::string
  ExtrapolationEnergy::name() const
  {
    return "extrapolation energy";
  }



  std::string
  ExtrapolationEnergy::documentation() const
  {
    return "Energy norm of the difference to a reference solution on a finer mesh or of higher "
           "degree, "
           "integrated on the reference mesh and gathered per cell.";
  }



  bool
  ExtrapolationEnergy::needs_reference() const
  {
    return true;
  }



  bool
  ExtrapolationEnergy::needs_exact_displacement() const
  {
    return false;
  }



  bool
  ExtrapolationEnergy::is_energy_norm() const
  {
    return true;
  }



  Estimate
  ExtrapolationEnergy::estimate(const EstimateInput &input) const
  {
    const compare::Difference &difference = input.comparison.to_reference();
    return {difference.cell_energy, difference.energy};
  }
} // namespace tetradapt::estimate
