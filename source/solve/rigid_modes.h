// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_rigid_modes_h
#define tetradapt_source_solve_rigid_modes_h

#include "tetradapt/mechanics/supports.h"
#include "tetradapt/solve/aggregation.h"

namespace tetradapt::solve
{
  /** Where an owned node of @p space is: at a vertex or in the middle of an edge. */
  dealii::Point<3>
  position(const mechanics::DisplacementSpace &space, unsigned int node);

  /** The six rigid motions of the body at the owned nodes, zero where @p prescribed holds. */
  std::vector<NodeModes<3>>
  rigid_modes(const mechanics::DisplacementSpace      &space,
              const mechanics::PrescribedDisplacement &prescribed);
} // namespace tetradapt::solve

#endif
