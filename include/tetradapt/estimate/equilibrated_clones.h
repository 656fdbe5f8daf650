// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_clones_h
#define tetradapt_estimate_equilibrated_clones_h

#include "tetradapt/core/function_clones.h"

namespace tetradapt::estimate
{
  /** Eight numbers that the processor works on together. */
  using Lanes = double __attribute__((vector_size(64)));
} // namespace tetradapt::estimate

#endif
