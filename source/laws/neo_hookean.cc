// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/laws/neo_hookean.h"

#include "tetradapt/core/exceptions.h"

#include <cmath>

namespace tetradapt::laws
{
  namespace
  {
    /** 2/3 x - ((1 + x)^(2/3) - 1), without loss of digits for small x. */
    double
    above_root(const double x)
    {
      if (std::abs(x) > 0.01)
        return 2. / 3. * x - std::expm1(2. / 3. * std::log1p(x));
      // Minus the binomial series from its second order on, to rounding.
      double sum = 0., term = 2. / 3. * x;
      for (int k = 2; k < 10; ++k)
        {
          term *= (2. / 3. - (k - 1)) / k * x;
          sum -= term;
        }
      return sum;
    }
  } // namespace

  NeoHookean::NeoHookean(const double young_modulus, const double poisson_ratio)
    : lambda(young_modulus * poisson_ratio / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio))),
      mu(young_modulus / (2. * (1. + poisson_ratio)))
  {
    if (!(young_modulus > 0.) || !(poisson_ratio > -1.) || !(poisson_ratio < 0.5))
      throw core::InputError("The neo-Hookean law needs E > 0 and -1 < nu < 0.5, but E = "
                             + std::to_string(young_modulus)
                             + " and nu = " + std::to_string(poisson_ratio) + ".");
  }

  Hyperelastic::MaterialResponse
  NeoHookean::evaluate(const Strain &strain, const bool with_tangent) const
  {
    const SymmetricTensor<2, 3> &inverse = strain.inverse_C;
    const double                 log_J   = std::log1p(strain.J_minus_1);
    MaterialResponse             result;
    // tr C - 3 - 2 ln J in two parts of second order
    result.energy = 0.5 * mu * (strain.shape + 2. * above_logarithm(strain.J_minus_1))
                    + 0.5 * lambda * log_J * log_J;
    // I - C^-1 = C^-1 (C - I)
    result.stress = mu * symmetrize(Tensor<2, 3>(inverse) * Tensor<2, 3>(strain.twice_E))
                    + lambda * log_J * inverse;
    if (with_tangent)
      result.tangent = lambda * outer_product(inverse, inverse)
                       + 2. * (mu - lambda * log_J) * inverse_derivative(inverse);
    return result;
  }

  SplitNeoHookean::SplitNeoHookean(const double shear_modulus, const double bulk_modulus)
    : mu(shear_modulus), kappa(bulk_modulus)
  {
    if (!(mu > 0.) || !(kappa > 0.))
      throw core::InputError("The split neo-Hookean law needs positive moduli, but the shear "
                             "modulus is "
                             + std::to_string(mu) + " and the bulk modulus " + std::to_string(kappa)
                             + ".");
  }

  ModuliAtRest
  SplitNeoHookean::moduli_at_rest() const
  {
    const double ratio = mu / kappa;
    return {9. * mu / (3. + ratio), (3. - 2. * ratio) / (6. + 2. * ratio)};
  }

  Hyperelastic::MaterialResponse
  SplitNeoHookean::evaluate(const Strain &strain, const bool with_tangent) const
  {
    const SymmetricTensor<2, 3>  I       = dealii::unit_symmetric_tensor<3>();
    const SymmetricTensor<2, 3> &inverse = strain.inverse_C;
    const double                 J = strain.J, x = strain.J_minus_1;
    const double                 scaled = mu / std::cbrt(J * J);      // mu J^(-2/3)
    const double                 more   = trace(strain.twice_E) / 3.; // tr C / 3 - 1
    const double                 push   = kappa * J * x;
    MaterialResponse             result;
    // tr C / 3 - J^(2/3) in two parts of second order
    result.energy = 1.5 * scaled * (strain.shape / 3. + above_root(x)) + 0.5 * kappa * x * x;
    // I - tr C / 3 C^-1 = C^-1 (C - tr C / 3 I)
    result.stress
      = scaled * symmetrize(Tensor<2, 3>(inverse) * Tensor<2, 3>(strain.twice_E - more * I))
        + push * inverse;
    if (with_tangent)
      result.tangent = 2. * scaled
                         * ((1. + more) * inverse_derivative(inverse)
                            + ((1. + more) * outer_product(inverse, inverse)
                               - outer_product(I, inverse) - outer_product(inverse, I))
                                / 3.)
                       + (push + kappa * J * J) * outer_product(inverse, inverse)
                       - 2. * push * inverse_derivative(inverse);
    return result;
  }
} // namespace tetradapt::laws
