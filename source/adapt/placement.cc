// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/placement.h"

#include "tetradapt/compare/excluded_region.h"
#include "tetradapt/estimate/goal_points.h"
#include "tetradapt/mechanics/held_loads.h"
#include "tetradapt/mechanics/point_conditions.h"
#include "tetradapt/mechanics/sliding_normals.h"
#include "tetradapt/mechanics/springs.h"
#include "tetradapt/mechanics/surface_loads.h"

namespace tetradapt::adapt
{
  void
  check_placement(const scene::Scene                         &scene,
                  const std::shared_ptr<const mesh::TetMesh> &mesh,
                  const core::Log                            &log)
  {
    mechanics::SurfaceLoads(scene, *mesh).check();
    for (const auto &warning : mechanics::held_load_warnings(scene, *mesh))
      log.warning(scene.with_place(warning));
    for (const auto &warning : mechanics::held_point_force_warnings(scene, *mesh))
      log.warning(scene.with_place(warning));
    for (const auto &warning : mechanics::sliding_warnings(scene, *mesh))
      log.warning(scene.with_place(warning));
    for (const auto &warning : mechanics::check_springs(scene, *mesh))
      log.warning(scene.with_place(warning));
    const compare::ExcludedRegion excluded(scene, *mesh);
    for (const auto &goal : scene.goals)
      if (goal.type == scene::GoalType::point_displacement
          || goal.type == scene::GoalType::point_stress)
        for (const auto &part : excluded.all_parts())
          if (part.contains(goal.point))
            log.warning(scene.with_place(
              "Goals/" + goal.name + "/Point: it lies " + part.text() + ", where " + part.name
              + " acts and the solution, and the goal's value, may not converge there. Move it "
                "away."));
    for (const auto &warning : estimate::check_goal_points(scene, mesh))
      log.warning(scene.with_place(warning));
  }
} // namespace tetradapt::adapt
