// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/cauchy_stress.h"

#include "tetradapt/core/exceptions.h"

namespace tetradapt::mechanics
{
  dealii::SymmetricTensor<2, 3>
  cauchy_stress(const laws::ConstitutiveLaw &law, const dealii::Tensor<2, 3> &G)
  {
    AssertThrow(law.n_history() == 0, dealii::ExcNotImplemented());
    laws::Response response;
    if (!law.update(G, {}, false, response))
      throw core::NumericalError("A material has no stress at a deformation of the body: elements "
                                 "are turned inside out.");
    return law.cauchy_stress(G, response);
  }
} // namespace tetradapt::mechanics
