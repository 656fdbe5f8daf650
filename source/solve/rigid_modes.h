// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_rigid_modes_h
#define tetradapt_source_solve_rigid_modes_h

#include "tetradapt/fem/fixed_unknowns.h"
#include "tetradapt/solve/aggregation.h"

namespace tetradapt::solve
{
  /** The six rigid motions of the body at the owned nodes, zero in fixed components. */
  std::vector<NodeModes<3>>
  rigid_modes(const fem::Space &space, const fem::FixedUnknowns &fixed);
} // namespace tetradapt::solve

#endif
