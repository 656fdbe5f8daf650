// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_loads_h
#define tetradapt_mechanics_loads_h

#include "tetradapt/mechanics/displacement_space.h"
#include "tetradapt/mechanics/material_map.h"

namespace tetradapt::mechanics
{
  /**
   * Consistent nodal forces of the scene's loads, one a field node: integrals of
   * the shape functions times tractions and pressures over the patches that
   * carry a load's name, body forces, weight, and int B^T C eps_thermal. Complete
   * on the nodes that this rank owns.
   *
   * Faces are integrated with 7 points (degree 5), cells with 14 (degree 5 for
   * the rule in use); constants are integrated exactly.
   *
   * LoadType::nodal_force is no integral: its value acts at every point of the mesh on
   * the chosen faces (with degree 2 at the vertices only). The total grows with the number
   * of these points, so that another mesh is another problem, whose energies cannot be
   * compared.
   */
  std::vector<dealii::Tensor<1, 3>>
  nodal_forces(const scene::Scene      &scene,
               const MaterialMap       &materials,
               const DisplacementSpace &space);
} // namespace tetradapt::mechanics

#endif
