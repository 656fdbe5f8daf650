// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_goal_oriented_h
#define tetradapt_estimate_goal_oriented_h

#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  /** Dual weighted residual (Becker and Rannacher, Acta Numerica 10, 2001) for one
   * goal of the scene: global is the estimated error of the goal with its sign, in
   * its unit, and the indicators are roots of what the cells contribute to it. */
  class GoalOriented : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };
} // namespace tetradapt::estimate

#endif
