// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_multigrid_h
#define tetradapt_solve_hexahedral_multigrid_h

#include "tetradapt/solve/hexahedral_loads.h"
#include "tetradapt/solve/hexahedral_stiffness.h"
#include "tetradapt/solve/preconditioners.h"

namespace tetradapt::solve
{
  /** One degree on the cells of a forest: nodes, stiffness and supports. */
  struct HexahedralLevel
  {
    /** Collective. */
    HexahedralLevel(const scene::Scene           &scene,
                    const mechanics::MaterialMap &materials,
                    const HexahedralForest       &forest,
                    unsigned int                  degree);

    const HexahedralForest &forest;
    HexahedralSpace         space;
    HexahedralStiffness     stiffness;
    Vector                  positions;
    HexahedralSupports      supports;
  };

  /** Smoothed-aggregation AMG (Trilinos ML) with the six rigid motions as near null
   * space, for the assembled stiffness of a level of degree 1. Collective. */
  std::unique_ptr<Preconditioner>
  make_amg(const HexahedralLevel &level);

  /**
   * One V-cycle of p-multigrid: Chebyshev smoothing with the diagonal on the @p fine
   * level, and the level of degree 1 on the same cells solved by one cycle of AMG. The
   * functions of degree 1 are among those of the higher degree, hanging nodes
   * included. Keeps references to both levels. Collective.
   */
  std::unique_ptr<Preconditioner>
  make_p_multigrid(const HexahedralLevel &fine, const HexahedralLevel &coarse);
} // namespace tetradapt::solve

#endif
