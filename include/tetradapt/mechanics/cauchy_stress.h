// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_cauchy_stress_h
#define tetradapt_mechanics_cauchy_stress_h

#include "tetradapt/laws/constitutive_law.h"

namespace tetradapt::mechanics
{
  /**
   * Cauchy's stress, force per deformed area, of any law without history at the displacement
   * gradient @p G = du/dX.
   * @throws core::NumericalError if the law has no response to that deformation.
   */
  dealii::SymmetricTensor<2, 3>
  cauchy_stress(const laws::ConstitutiveLaw &law, const dealii::Tensor<2, 3> &G);
} // namespace tetradapt::mechanics

#endif
