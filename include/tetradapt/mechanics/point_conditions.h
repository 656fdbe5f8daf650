// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_point_conditions_h
#define tetradapt_mechanics_point_conditions_h

#include "tetradapt/mechanics/supports.h"

namespace tetradapt::mechanics
{
  /** The vertex of the mesh that a point load acts on, with degree 2, too, and its force. */
  std::pair<unsigned int, dealii::Tensor<1, 3>>
  point_force(const scene::LoadParameters &load, const mesh::TetMesh &mesh);

  /** The field nodes that a support at a point or on a line holds: vertices, and for degree 2 the
   * middles of the edges between them. @param edges is null for degree 1. */
  std::vector<unsigned int>
  held_place_nodes(const scene::SupportParameters &support,
                   const mesh::TetMesh            &mesh,
                   const mesh::EdgeTable          *edges);

  /** What to tell the user about point forces that act on vertices which supports hold in a
   * component that the force has: these components deform nothing.
   * @throws core::InputError as prescribe() does. */
  std::vector<std::string>
  held_point_force_warnings(const scene::Scene &scene, const mesh::TetMesh &mesh);
} // namespace tetradapt::mechanics

#endif
