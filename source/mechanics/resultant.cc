// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/resultant.h"

#include <deal.II/base/mpi.h>

namespace tetradapt::mechanics
{
  Resultant
  sum(const Resultant &resultant, const MPI_Comm communicator)
  {
    return {dealii::Utilities::MPI::sum(resultant.force, communicator),
            dealii::Utilities::MPI::sum(resultant.moment, communicator)};
  }
} // namespace tetradapt::mechanics
