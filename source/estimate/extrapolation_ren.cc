// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  std::string
  ExtrapolationRen::name() const
  {
    return "extrapolation ren";
  }



  std::string
  ExtrapolationRen::documentation() const
  {
    return "Relative error norm of every node against a reference solution, |P-Q|/|P0-Q|, summed "
           "over the "
           "nodes of a cell. A displacement error: it shows where an error is felt, not where it "
           "is "
           "made, and refining by it need not converge.";
  }



  bool
  ExtrapolationRen::needs_reference() const
  {
    return true;
  }



  bool
  ExtrapolationRen::needs_exact_displacement() const
  {
    return false;
  }



  bool
  ExtrapolationRen::is_energy_norm() const
  {
    return false;
  }



  Estimate
  ExtrapolationRen::estimate(const EstimateInput &input) const
  {
    const compare::NodalRen &ren = input.comparison.ren_to_reference();
    return {ren.cell_sums, ren.mean};
  }
} // namespace tetradapt::estimate
