// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  std::string
  ExactEnergy::name() const
  {
    return "exact energy";
  }



  std::string
  ExactEnergy::documentation() const
  {
    return "Energy norm of the true error, for scenes that give the exact displacement.";
  }



  bool
  ExactEnergy::needs_reference() const
  {
    return false;
  }



  bool
  ExactEnergy::needs_exact_displacement() const
  {
    return true;
  }



  bool
  ExactEnergy::is_energy_norm() const
  {
    return true;
  }



  Estimate
  ExactEnergy::estimate(const EstimateInput &input) const
  {
    const compare::Difference &difference = input.comparison.to_truth();
    return {difference.cell_energy, difference.energy};
  }
} // namespace tetradapt::estimate
