// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_pairing_h
#define tetradapt_source_solve_pairing_h

#include "tetradapt/solve/aggregation.h"

namespace tetradapt::solve
{
  /**
   * Puts the nodes of this rank into sets of four at most: each node is paired with the free
   * one that it is coupled to most, in Frobenius' norm, and each pair with another one
   * (Y. Notay, An aggregation-based algebraic multigrid method, ETNA 37, 2010). Nodes
   * without any coupling get no aggregate. In thin bodies larger ones would move too stiffly: their
   * rigid motions can follow bending only where they are small.
   */
  template <unsigned int n>
  Aggregates
  pair_twice(const BlockRows<n, n> &matrix);
} // namespace tetradapt::solve

#endif
