// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_extrapolation_h
#define tetradapt_estimate_extrapolation_h

#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  /** The energy norm of the difference to a reference solution on a finer mesh or
   * of higher degree. */
  class ExtrapolationEnergy : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };

  /** The 2015 report's estimator. A cell's indicator is the sum of the relative
   * error norms of its nodes against the reference; global is the mean over all
   * nodes. Dimensionless, no energy norm. */
  class ExtrapolationRen : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };

  /** The energy norm of the true error, for scenes whose exact displacement is
   * known. */
  class ExactEnergy : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };

  /** The energy norm of the difference to the solution of the next degree on the
   * same mesh, p-extrapolation on the whole mesh: degree 2 for degree 1; for degree
   * 2 the space enriched by cubic functions of edges and faces. */
  class DegreeExtrapolation : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };

  /**
   * The same difference, but solved for roughly, without factors or multigrid: the
   * residual is zero for all functions of degree p, so what is missing has no smooth part,
   * and a few steps of conjugate gradients with the 3x3 diagonal blocks as preconditioner,
   * which act from function to function only, find most of it: 4 to 6 for Poisson ratios up to
   * 0.4, up to 16 near 0.5. What further steps would gain is continued from the last ones as a
   * geometric series, and the indicators are scaled to include it.
   *
   * As the next degree has an error of its own, this falls short of the error: by little
   * where the solution is smooth, by a tenth to a sixth where singularities dominate.
   */
  class LocalDegreeExtrapolation : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };

  /**
   * Richardson's extrapolation of the energy over the last three cycles, E_h = E -+ c N^-r (loads
   * raise it, prescribed displacements lower it) with the rate r that they show, so that
   * |||u - u_h|||^2 = c N^-r. The distribution over the cells is that of the
   * superconvergent patch recovery, scaled to the global value.
   *
   * The estimate is missing, with the indicators of the patch recovery, before the third
   * cycle and where the three energies do not converge at a rate between 0.25 and 4p/3.
   * Throws core::InputError if both loads and prescribed displacements act.
   */
  class Richardson : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };
} // namespace tetradapt::estimate

#endif
