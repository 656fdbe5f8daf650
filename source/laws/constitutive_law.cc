// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/laws/constitutive_law.h"

#include <cmath>

namespace tetradapt::laws
{
  ModuliAtRest
  ConstitutiveLaw::moduli_at_rest() const
  {
    // Projections on the two isotropic tensors: C_iijj = 9 K and C_ijij = 3 K + 10 mu.
    const SymmetricTensor<4, 3> C          = tangent_at_rest();
    double                      volumetric = 0., whole = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          volumetric += C[i][i][j][j];
          whole += C[i][j][i][j];
        }
    const double bulk = volumetric / 9., mu = (whole - 3. * bulk) / 10.;
    return {9. * bulk * mu / (3. * bulk + mu), (3. * bulk - 2. * mu) / (6. * bulk + 2. * mu)};
  }

  double
  shear_modulus(const ConstitutiveLaw &law)
  {
    const SymmetricTensor<4, 3> C = law.tangent_at_rest();
    return (C[0][1][0][1] + C[1][2][1][2] + C[2][0][2][0]) / 3.;
  }

  bool
  LinearLaw::update(const Tensor<2, 3> &G,
                    const History,
                    const bool with_tangent,
                    Response  &response) const
  {
    response.energy = 0.5 * energy_density(symmetrize(G));
    response.stress = Tensor<2, 3>(stress(G));
    if (with_tangent)
      {
        const SymmetricTensor<4, 3> C = tangent_at_rest();
        for (unsigned int a = 0; a < 9; ++a)
          for (unsigned int b = a; b < 9; ++b)
            response.tangent[tangent_index(a, b)] = C[a / 3][a % 3][b / 3][b % 3];
      }
    return std::isfinite(response.energy);
  }

  SymmetricTensor<2, 3>
  LinearLaw::cauchy_stress(const Tensor<2, 3> &, const Response &response) const
  {
    return symmetrize(response.stress);
  }
} // namespace tetradapt::laws
