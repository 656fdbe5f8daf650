// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_lanes_h
#define tetradapt_core_lanes_h

namespace tetradapt::core
{
  constexpr unsigned int n_lanes = 8;

  /**
   * Eight numbers that the processor works on together; may be laid over doubles.
   *
   * The alignment is given, as that of allocated memory: without it clones for wide vectors
   * (clones.h) count on 64 bytes where what calls them, compiled for any processor, gives 16.
   */
  using Lanes
    = double __attribute__((vector_size(8 * n_lanes), aligned(2 * sizeof(double)), may_alias));
} // namespace tetradapt::core

#endif
