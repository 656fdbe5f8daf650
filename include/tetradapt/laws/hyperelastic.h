// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_laws_hyperelastic_h
#define tetradapt_laws_hyperelastic_h

#include "tetradapt/laws/constitutive_law.h"

namespace tetradapt::laws
{
  /**
   * A law for large deformation with a stored energy psi(C), C = F^T F, which therefore is the
   * same however the body is turned. A class of the family gives the second Piola-Kirchhoff
   * stress S = 2 dpsi/dC and its derivative CC = 2 dS/dC; here they become P = F S and
   * A_iJkL = delta_ik S_JL + F_iM CC_MJNL F_kN (Holzapfel, Nonlinear Solid Mechanics, sections
   * 6.1 and 6.6).
   */
  class Hyperelastic : public ConstitutiveLaw
  {
  public:
    bool
    supports(Formulation formulation) const override;

    /** False where det F is not positive, or a number is not finite. */
    bool
    update(const Tensor<2, 3> &G,
           History             history,
           bool                with_tangent,
           Response           &response) const override;

    /** P F^T / det F */
    SymmetricTensor<2, 3>
    cauchy_stress(const Tensor<2, 3> &G, const Response &response) const override;

    SymmetricTensor<4, 3>
    tangent_at_rest() const override;

  protected:
    /** A strain, exact also where it is small. */
    struct Strain
    {
      SymmetricTensor<2, 3> twice_E; ///< C - I = G + G^T + G^T G
      SymmetricTensor<2, 3> inverse_C;
      double                J         = 1.;
      double                J_minus_1 = 0.;
      /** tr(C - I) - 2 (J - 1), of second order in G. */
      double shape = 0.;
    };

    /** What a class of the family computes. */
    struct MaterialResponse
    {
      double                energy = 0.;
      SymmetricTensor<2, 3> stress;  ///< S
      SymmetricTensor<4, 3> tangent; ///< CC, if it was asked for
    };

    /** @param strain with a positive J. */
    virtual MaterialResponse
    evaluate(const Strain &strain, bool with_tangent) const = 0;
  };

  /** x - ln(1 + x), without loss of digits for small x. */
  double
  above_logarithm(double x);

  /** dC^-1/dC with the sign changed: 1/2 (C^-1_ik C^-1_jl + C^-1_il C^-1_jk). */
  SymmetricTensor<4, 3>
  inverse_derivative(const SymmetricTensor<2, 3> &inverse_C);
} // namespace tetradapt::laws

#endif
