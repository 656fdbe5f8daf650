// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/laws/linear_elastic.h"

#include "tetradapt/core/exceptions.h"

#include <cmath>

namespace tetradapt::laws
{
  LinearElastic::LinearElastic(double young_modulus, double poisson_ratio)
    : moduli{young_modulus, poisson_ratio},
      inverse_lambda((1. + poisson_ratio) * (1. - 2. * poisson_ratio)
                     / (young_modulus * poisson_ratio)),
      mu(young_modulus / (2. * (1. + poisson_ratio)))
  {
    if (!(young_modulus > 0.) || !(poisson_ratio > -1.) || !(poisson_ratio <= 0.5))
      throw core::InputError("Linear elasticity needs E > 0 and -1 < nu <= 0.5, but E = "
                             + std::to_string(young_modulus)
                             + " and nu = " + std::to_string(poisson_ratio) + ".");
    // Without volume change there is no volumetric stress to add to the deviator.
    lambda = poisson_ratio == 0.5
               ? -2. / 3. * mu
               : young_modulus * poisson_ratio / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
  }

  bool
  LinearElastic::supports(const Formulation formulation) const
  {
    return formulation == Formulation::displacement || formulation == Formulation::mixed;
  }

  SymmetricTensor<2, 3>
  LinearElastic::stress(const Tensor<2, 3> &G) const
  {
    const SymmetricTensor<2, 3> strain = symmetrize(G);
    return lambda * trace(strain) * dealii::unit_symmetric_tensor<3>() + 2. * mu * strain;
  }

  SymmetricTensor<4, 3>
  LinearElastic::tangent_at_rest() const
  {
    const auto I = dealii::unit_symmetric_tensor<3>();
    return lambda * outer_product(I, I) + 2. * mu * dealii::identity_tensor<3>();
  }

  ModuliAtRest
  LinearElastic::moduli_at_rest() const
  {
    return moduli;
  }

  double
  LinearElastic::energy_density(const SymmetricTensor<2, 3> &strain) const
  {
    const double volumetric = trace(strain);
    return lambda * volumetric * volumetric + 2. * mu * (strain * strain);
  }

  double
  LinearElastic::complementary_density(const SymmetricTensor<2, 3> &stress) const
  {
    const double pressure_part = trace(stress);
    const double ratio         = inverse_lambda == 0. ? 1. / 3. : lambda / (3. * lambda + 2. * mu);
    return (stress * stress - ratio * pressure_part * pressure_part) / (2. * mu);
  }

  std::optional<PressureForm>
  LinearElastic::pressure_form() const
  {
    if (!(inverse_lambda >= 0.) || !std::isfinite(inverse_lambda))
      return std::nullopt;
    // mu was best of 0, 1/2, 1, 3/2 and 2 mu in iterations of the solver and errors together; for
    // small lambda a half of it.
    const double kept = inverse_lambda * mu > 0.5 ? 0.5 / inverse_lambda : mu;
    return PressureForm{mu, kept, inverse_lambda / (1. - kept * inverse_lambda)};
  }
} // namespace tetradapt::laws
