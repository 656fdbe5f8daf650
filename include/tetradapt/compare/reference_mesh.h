// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_reference_mesh_h
#define tetradapt_compare_reference_mesh_h

#include "tetradapt/core/log.h"
#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::compare
{
  /**
   * Makes the mesh of the scene's reference of type fine_mesh: refines
   * @p initial_mesh by TetGen with the reference's own bounds on volume, size and
   * quality, or cuts the scene's box into bricks, or reads a file. Supports and
   * loads are marked on its boundary. Not collective.
   *
   * @throws InputError, NumericalError as TetGen, the readers and select_faces() do.
   */
  mesh::TetMesh
  reference_mesh(const scene::Scene  &scene,
                 const mesh::TetMesh &initial_mesh,
                 const core::Log     &log);
} // namespace tetradapt::compare

#endif
