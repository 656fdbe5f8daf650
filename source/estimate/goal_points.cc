// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/goal_points.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::estimate
{
  namespace
  {
    /** Of the body's size: points that were read from a file in single precision are on its
     * surface. */
    constexpr double rounding = 1e-6;

    bool
    has_point(const scene::GoalParameters &goal)
    {
      return goal.type == scene::GoalType::point_displacement
             || goal.type == scene::GoalType::point_stress;
    }

    /** "Goals/tip/Point: (2, 0, 0) lies 1 outside of <what>; the nearest point is (1, 0, 0)". */
    std::string
    outside_text(const scene::GoalParameters &goal,
                 const mesh::TetMesh         &mesh,
                 const compare::Location     &found,
                 const std::string           &what)
    {
      std::ostringstream text;
      text << "Goals/" << goal.name << "/Point: " << mesh::to_string(goal.point) << " lies "
           << found.distance << " outside of " << what << ", whose nearest point is "
           << mesh::to_string(position(mesh, found));
      return text.str();
    }

    [[noreturn]] void
    refuse(const scene::GoalParameters &goal,
           const mesh::TetMesh         &mesh,
           const compare::Location     &found)
    {
      throw core::InputError(outside_text(goal, mesh, found, "the body")
                             + ". Move it there or inside.");
    }
  } // namespace

  dealii::Point<3>
  position(const mesh::TetMesh &mesh, const compare::Location &found)
  {
    dealii::Point<3> point;
    for (unsigned int i = 0; i < 4; ++i)
      point += found.barycentric[i] * dealii::Tensor<1, 3>(mesh.points[mesh.cells[found.cell][i]]);
    return point;
  }

  double
  sliver_size(const mesh::TetMesh &mesh, const compare::Location &found)
  {
    return 0.5 * std::cbrt(mesh::cell_volume(mesh, found.cell));
  }

  compare::Location
  locate_goal(const scene::GoalParameters &goal, const compare::PointLocator &locator)
  {
    const compare::Location found = locator.locate(goal.point);
    if (found.distance > sliver_size(locator.mesh(), found))
      refuse(goal, locator.mesh(), found);
    return found;
  }

  std::vector<std::string>
  check_goal_points(const scene::Scene &scene, const std::shared_ptr<const mesh::TetMesh> &mesh)
  {
    std::vector<std::string> warnings;
    if (std::none_of(scene.goals.begin(), scene.goals.end(), has_point))
      return warnings;
    const auto                  box       = mesh::bounding_box(*mesh);
    const double                tolerance = rounding * box.first.distance(box.second);
    const compare::PointLocator locator(mesh);
    const bool                  near_body
      = scene.mesh.projection != scene::MeshParameters::Projection::none
        || (scene.mesh.source == scene::MeshSource::surface && scene.mesh.surface_edge_length > 0.);
    for (const auto &goal : scene.goals)
      if (has_point(goal))
        {
          const compare::Location found = locate_goal(goal, locator);
          if (found.distance <= tolerance)
            continue;
          if (!near_body)
            refuse(goal, *mesh, found);
          warnings.push_back(outside_text(goal, *mesh, found, "the mesh") + ", where it is taken.");
        }
    return warnings;
  }
} // namespace tetradapt::estimate
