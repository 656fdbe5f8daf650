// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_laws_neo_hookean_h
#define tetradapt_laws_neo_hookean_h

#include "tetradapt/laws/hyperelastic.h"

namespace tetradapt::laws
{
  /**
   * The compressible neo-Hookean law
   * psi = mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2
   * with Lame's moduli at rest (Bonet, Wood, Nonlinear Continuum Mechanics for Finite Element
   * Analysis, section 6.4.3).
   */
  class NeoHookean : public Hyperelastic
  {
  public:
    /** @param young_modulus E > 0 and @param poisson_ratio nu in (-1, 0.5), both at rest.
     *  @throws core::InputError outside these bounds. */
    NeoHookean(double young_modulus, double poisson_ratio);

  protected:
    MaterialResponse
    evaluate(const Strain &strain, bool with_tangent) const override;

  private:
    double lambda, mu;
  };

  /**
   * The neo-Hookean law with isochoric and volumetric parts
   * psi = mu/2 (J^(-2/3) tr C - 3) + kappa/2 (J - 1)^2,
   * as Abaqus and CalculiX have it: a pressure and a change of shape do not act on each other.
   */
  class SplitNeoHookean : public Hyperelastic
  {
  public:
    /** @param shear_modulus mu > 0 and @param bulk_modulus kappa > 0.
     *  @throws core::InputError otherwise. */
    SplitNeoHookean(double shear_modulus, double bulk_modulus);

    ModuliAtRest
    moduli_at_rest() const override;

  protected:
    MaterialResponse
    evaluate(const Strain &strain, bool with_tangent) const override;

  private:
    double mu, kappa;
  };
} // namespace tetradapt::laws

#endif
