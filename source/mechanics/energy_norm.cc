// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/energy_norm.h"

namespace tetradapt::mechanics
{
  double
  shear_modulus(const ConstitutiveLaw &law)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        SymmetricTensor<2, 3> shear; // its density is 4 mu strain_ij^2
        shear[i][(i + 1) % 3] = 0.5;
        sum += law.energy_density(shear);
      }
    return sum / 3.;
  }
} // namespace tetradapt::mechanics
