// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_placement_h
#define tetradapt_adapt_placement_h

#include "tetradapt/core/log.h"
#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/scene.h"

#include <memory>

namespace tetradapt::adapt
{
  /**
   * Looks at where the loads and goals of @p scene lie on one of its meshes: warns of loads on
   * faces that supports hold, and of goals' points that the mesh only just leaves out.
   * @throws core::InputError for a goal's point outside of the body.
   */
  void
  check_placement(const scene::Scene                         &scene,
                  const std::shared_ptr<const mesh::TetMesh> &mesh,
                  const core::Log                            &log);
} // namespace tetradapt::adapt

#endif
