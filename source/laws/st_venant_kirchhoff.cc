// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/laws/st_venant_kirchhoff.h"

#include "tetradapt/core/exceptions.h"

namespace tetradapt::laws
{
  StVenantKirchhoff::StVenantKirchhoff(const double young_modulus, const double poisson_ratio)
    : lambda(young_modulus * poisson_ratio / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio))),
      mu(young_modulus / (2. * (1. + poisson_ratio)))
  {
    if (!(young_modulus > 0.) || !(poisson_ratio > -1.) || !(poisson_ratio < 0.5))
      throw core::InputError("The law of St. Venant and Kirchhoff needs E > 0 and -1 < nu < 0.5, "
                             "but E = "
                             + std::to_string(young_modulus)
                             + " and nu = " + std::to_string(poisson_ratio) + ".");
  }

  Hyperelastic::MaterialResponse
  StVenantKirchhoff::evaluate(const Strain &strain, const bool with_tangent) const
  {
    const SymmetricTensor<2, 3> I = dealii::unit_symmetric_tensor<3>();
    const SymmetricTensor<2, 3> E = 0.5 * strain.twice_E;
    MaterialResponse            result;
    result.stress = lambda * trace(E) * I + 2. * mu * E;
    result.energy = 0.5 * (result.stress * E);
    if (with_tangent)
      result.tangent = lambda * outer_product(I, I) + 2. * mu * dealii::identity_tensor<3>();
    return result;
  }
} // namespace tetradapt::laws
