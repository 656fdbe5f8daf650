// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_multigrid_h
#define tetradapt_solve_hexahedral_multigrid_h

#include "tetradapt/solve/hexahedral_loads.h"
#include "tetradapt/solve/hexahedral_stiffness.h"
#include "tetradapt/solve/preconditioners.h"

namespace tetradapt::solve
{
  /** One degree on the cells of a forest: unknowns, supports and stiffness. */
  struct HexahedralLevel
  {
    HexahedralSpace                      space;
    Constraints                          constraints; ///< hanging nodes and supports
    std::unique_ptr<HexahedralStiffness> stiffness;
  };

  /** A degree and degree 1 on the same cells: what p-multigrid needs. */
  struct HexahedralLevels
  {
    /** Collective. */
    HexahedralLevels(const scene::Scene           &scene,
                     const mechanics::MaterialMap &materials,
                     const HexahedralForest       &forest,
                     unsigned int                  degree);

    HexahedralLevel fine, coarse;
    MatrixFree      matrix_free; ///< has the fine level as number 0, the coarse one as 1
  };

  /** One cycle of the project's smoothed aggregation, see make_amg(), for the stiffness of a
   * level of degree 1. Its vectors have the level's owned unknowns. Collective. */
  std::unique_ptr<Preconditioner>
  make_hexahedral_amg(const HexahedralLevel &level);

  /**
   * One V-cycle of p-multigrid by global coarsening: Chebyshev smoothing with the diagonal on
   * the fine level, and the level of degree 1 on the same cells solved by one cycle of AMG.
   * Keeps a reference to the levels. Collective.
   */
  std::unique_ptr<Preconditioner>
  make_hexahedral_multigrid(const HexahedralLevels &levels);
} // namespace tetradapt::solve

#endif
