// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_loads_h
#define tetradapt_solve_hexahedral_loads_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/solve/hexahedral_forest.h"

namespace tetradapt::solve
{
  /** The rest positions of the local nodes, ghosts included, as a vector of the space.
   * Collective. */
  Vector
  node_positions(const HexahedralForest &forest, const HexahedralSpace &space);

  /** What the supports prescribe at the local nodes, ghosts included. */
  struct HexahedralSupports
  {
    std::vector<unsigned char> fixed;  ///< one a node; bit c is set: component c is prescribed
    Vector                     values; ///< prescribed values, zero elsewhere

    /** Zero at what is prescribed. */
    void
    set_zero(Vector &vector) const;
  };

  /**
   * Evaluates the supports at the nodes of the sides that they select. Where two
   * supports meet, the one that the scene lists last holds. Collective.
   * @param positions of node_positions().
   */
  HexahedralSupports
  prescribe(const std::vector<scene::SupportParameters> &supports,
            const HexahedralForest                      &forest,
            const HexahedralSpace                       &space,
            const Vector                                &positions);

  /**
   * Consistent nodal forces of tractions, pressures, body forces, weight and thermal
   * strain, by Gauss' rule with degree + 2 points in each direction. Collective.
   *
   * @param mesh of the scene, whose region names loads may use.
   */
  Vector
  nodal_forces(const scene::Scene           &scene,
               const mesh::TetMesh          &mesh,
               const mechanics::MaterialMap &materials,
               const HexahedralForest       &forest,
               const HexahedralSpace        &space);
} // namespace tetradapt::solve

#endif
