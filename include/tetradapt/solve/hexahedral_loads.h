// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_loads_h
#define tetradapt_solve_hexahedral_loads_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/solve/hexahedral_space.h"

namespace tetradapt::solve
{
  /**
   * The constraints of hanging nodes, and what the supports prescribe at the nodes of the
   * sides that they select. Where two supports meet, the one that the scene lists last holds.
   * Closed. Collective.
   */
  Constraints
  make_constraints(const std::vector<scene::SupportParameters> &supports,
                   const HexahedralSpace                       &space);

  /**
   * Consistent nodal forces of tractions, pressures, body forces, weight and thermal
   * strain, by Gauss' rule with degree + 2 points in each direction. Collective.
   *
   * @param mesh of the scene, whose region names loads may use.
   * @param forces are overwritten. Their layout has the unknowns of own cells, and what these
   *        depend on.
   */
  void
  nodal_forces(const scene::Scene           &scene,
               const mesh::TetMesh          &mesh,
               const mechanics::MaterialMap &materials,
               const HexahedralSpace        &space,
               Vector                       &forces);
} // namespace tetradapt::solve

#endif
