// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_residual_h
#define tetradapt_estimate_residual_h

#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  /**
   * Residual estimator (Babuska and Rheinboldt, IJNME 12, 1978), with the constant 1/24 of
   * Kelly, Gago, Zienkiewicz and Babuska (IJNME 19, 1983) and the degree p as there:
   *
   *   eta_K^2 = 1/(24 p) ( h_K^2 / mu int_K |f + div s_h|^2
   *                        + sum_F h_F int_F j . Q_F^-1 j ),
   *
   * with j the jump of the traction across a face, or on the boundary what is missing to
   * the given traction in its known components, which counts twice, for no other cell
   * shares it. h_F is the height of K over F, h_K three times the volume over the
   * mean area of the faces. Q_F = (Q_1 + Q_2)/2 is the mean of the acoustic tensors n . C . n
   * of the two cells: j . Q^-1 j is the energy density of the jump in the strain, so normal
   * jumps count with lambda + 2 mu and tangential ones with mu, and at an interface of
   * materials the stiffer one decides, which makes the bound independent of their
   * contrast (Petzoldt, Adv. Comp. Math. 16, 2002). mu is the shear modulus.
   *
   * In mixed form Q_F is that of mu and gamma (laws::PressureForm), and eta_K^2 has one more
   * term, the square of the volume's residual:
   * int_K |div u_h - tr eps_thermal + c p_h|^2 / (1/(2 mu + gamma) + c), c = 1/(lambda - gamma).
   *
   * It bounds the energy norm of the error from above and below up to constants that
   * depend on the shape of the cells only; they are not known, and the index of
   * effectivity is neither near 1 nor above it for sure. It misses what nodal forces do.
   */
  class Residual : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };
} // namespace tetradapt::estimate

#endif
