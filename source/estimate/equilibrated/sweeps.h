// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_sweeps_h
#define tetradapt_estimate_equilibrated_sweeps_h

#include "relaxation.h"

namespace tetradapt::estimate
{
  /** Sets the size and the factor of a move's matrix. */
  void
  factorise(const TractionRelaxation::State &state, TractionRelaxation::FaceMove &move);
  void
  factorise(const TractionRelaxation::State &state, TractionRelaxation::RingMove &move);

  /** Makes every move once, each as far as lowers the energy most. */
  void
  make_moves(TractionRelaxation::State &state);
} // namespace tetradapt::estimate

#endif
