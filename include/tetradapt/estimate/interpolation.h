// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_interpolation_h
#define tetradapt_estimate_interpolation_h

#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  /**
   * The energy norm of the interpolation error u - I_h u, cell by cell. Derivatives of degree
   * p + 1 of the displacement, constant in each cell, are recovered: those of the strain
   * are those of the polynomials of RecoveredStress, and u_i,kl = eps_il,k +
   * eps_ik,l - eps_kl,i. For a polynomial u of degree p + 1 the interpolation error is a sum of
   * HierarchicalSurplus functions, which is integrated exactly: no constant is needed.
   *
   * The solution is the best approximation in the energy norm (Cea), so |||u - u_h||| <=
   * |||u - I_h u|||, with the constant 1: where the recovered derivatives are right, this
   * is an upper bound. It is far from sharp for nearly incompressible materials, whose
   * interpolant changes its volume, and blind to singularities.
   */
  class Interpolation : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };
} // namespace tetradapt::estimate

#endif
