// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_h
#define tetradapt_estimate_equilibrated_h

#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  /** Guaranteed upper bound (Prager and Synge 1947): the distance of the stress to
   * one in exact equilibrium; see equilibrated_bound.h. */
  class Equilibrated : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };
} // namespace tetradapt::estimate

#endif
