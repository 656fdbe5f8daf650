// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_goal_oriented_h
#define tetradapt_estimate_goal_oriented_h

#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  /**
   * Dual weighted residual (Becker and Rannacher, Acta Numerica 10, 2001) for one goal
   * of the scene: Estimation/Goal, or its first one.
   *
   * With the dual solution z, a(v, z) = J(v), the error of the goal is J(u) - J(u_h) =
   * r(z) with the residual r of u_h, and with both corrections e_u, e_z to the next
   * degree (EnrichedProblem) it is r(z_h) + a(e_u, e_z): the first is what the solver
   * left, the second what the mesh lacks. Both corrections are known to about a tenth
   * at first; a(e_u, e_z) = r(e_z) + r_z(e_u) - a(e_u, e_z) is then known to a hundredth of
   * the product of their norms. Where the goal's error is not far above the product of what
   * is missing in them, because its contributions cancel, they are made more accurate.
   *
   * global is that error, with its sign and in the goal's unit: value + global is the better
   * value. Cell K contributes a_K(e_u, e_z); where both happen to be orthogonal there, at
   * least a twentieth of |||e_u|||_K |||e_z|||_K is counted. The indicators are the
   * roots of these sizes, which fall like h^p.
   */
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
