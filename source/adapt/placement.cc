// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/placement.h"

#include "tetradapt/estimate/goal_points.h"
#include "tetradapt/mechanics/held_loads.h"

namespace tetradapt::adapt
{
  void
  check_placement(const scene::Scene                         &scene,
                  const std::shared_ptr<const mesh::TetMesh> &mesh,
                  const core::Log                            &log)
  {
    for (const auto &warning : mechanics::held_load_warnings(scene, *mesh))
      log.warning(scene.with_place(warning));
    for (const auto &warning : estimate::check_goal_points(scene, mesh))
      log.warning(scene.with_place(warning));
  }
} // namespace tetradapt::adapt
