// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_laws_linear_elastic_h
#define tetradapt_laws_linear_elastic_h

#include "tetradapt/laws/constitutive_law.h"

namespace tetradapt::laws
{
  /**
   * Isotropic linear elasticity with small strains:
   * stress = lambda tr(strain) I + 2 mu strain, strain = (G + G^T)/2.
   *
   * With nu = 0.5 the strain determines the deviator of the stress only: stress(),
   * tangent_at_rest() and energy_density() give what belongs to that, and complementary_density()
   * is that of the deviator, for a pressure does not strain the material. Such a material can be
   * solved for in mixed form only.
   */
  class LinearElastic : public LinearLaw
  {
  public:
    /** @param young_modulus E > 0. @param poisson_ratio nu in (-1, 0.5].
     *  @throws core::InputError outside these bounds. */
    LinearElastic(double young_modulus, double poisson_ratio);

    bool
    supports(Formulation formulation) const override;
    SymmetricTensor<2, 3>
    stress(const Tensor<2, 3> &G) const override;
    SymmetricTensor<4, 3>
    tangent_at_rest() const override;
    ModuliAtRest
    moduli_at_rest() const override;
    double
    energy_density(const SymmetricTensor<2, 3> &strain) const override;
    double
    complementary_density(const SymmetricTensor<2, 3> &stress) const override;
    /** Keeps mu of lambda, but at most a half of lambda, in addition to the pressure. Empty for nu
     * <= 0, where lambda is not positive. */
    std::optional<PressureForm>
    pressure_form() const override;

  private:
    ModuliAtRest moduli;
    double       inverse_lambda; ///< 1 / lambda, infinite for nu = 0
    double       lambda;         ///< first Lame parameter; -2/3 mu for nu = 0.5
    double       mu;             ///< shear modulus
  };
} // namespace tetradapt::laws

#endif
