// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_flux_projection_h
#define tetradapt_estimate_flux_projection_h

#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  /** Zienkiewicz-Zhu (IJNME 24, 1987): the stress against its volume-weighted nodal
   * averages, one-sided at interfaces of regions. */
  class Averaging : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };

  /** Zienkiewicz-Zhu (IJNME 33, 1992): the stress against the one recovered by fits
   * at superconvergent points; see recovery/recovery.h. */
  class PatchRecovery : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };
} // namespace tetradapt::estimate

#endif
