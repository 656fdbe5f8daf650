// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_laws_st_venant_kirchhoff_h
#define tetradapt_laws_st_venant_kirchhoff_h

#include "tetradapt/laws/hyperelastic.h"

namespace tetradapt::laws
{
  /**
   * The law of St. Venant and Kirchhoff, psi = lambda/2 (tr E)^2 + mu E : E with Green and
   * Lagrange's strain E = (C - I)/2: linear elasticity that does not mind rotations. It
   * is meant for small strains; compressed to less than 1/sqrt(3) of its length, a bar of it
   * becomes softer until it yields.
   */
  class StVenantKirchhoff : public Hyperelastic
  {
  public:
    /** @param young_modulus E > 0 and @param poisson_ratio nu in (-1, 0.5).
     *  @throws core::InputError outside these bounds. */
    StVenantKirchhoff(double young_modulus, double poisson_ratio);

  protected:
    MaterialResponse
    evaluate(const Strain &strain, bool with_tangent) const override;

  private:
    double lambda, mu;
  };
} // namespace tetradapt::laws

#endif
