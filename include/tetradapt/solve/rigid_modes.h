// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_rigid_modes_h
#define tetradapt_solve_rigid_modes_h

#include "tetradapt/fem/fixed_unknowns.h"
#include "tetradapt/solve/aggregation.h"

namespace tetradapt::solve
{
  /** The six rigid motions at the owned nodes of @p space, of degree 1: the near null space of
   * its stiffness. Zero in fixed components. */
  std::vector<NodeModes<3>>
  rigid_modes(const fem::Space &space, const fem::FixedUnknowns &fixed);
} // namespace tetradapt::solve

#endif
