// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_goal_points_h
#define tetradapt_estimate_goal_points_h

#include "tetradapt/compare/point_locator.h"
#include "tetradapt/scene/scene.h"

#include <string>
#include <vector>

namespace tetradapt::estimate
{
  /** The point of the mesh that @p found stands for. */
  dealii::Point<3>
  position(const mesh::TetMesh &mesh, const compare::Location &found);

  /** How far outside of a mesh with curved walls a point may lie that is meant to be on one of
   * them: half the size of the cell next to it. */
  double
  sliver_size(const mesh::TetMesh &mesh, const compare::Location &found);

  /**
   * Where the Point of @p goal lies.
   * @throws core::InputError with the distance and the nearest point of the body if it lies more
   *         than sliver_size() outside.
   */
  compare::Location
  locate_goal(const scene::GoalParameters &goal, const compare::PointLocator &locator);

  /**
   * Checks that the points of all goals of @p scene lie in the body that @p mesh fills. A mesh
   * whose boundary is only near the body's (Mesh/Projection, or a surface that was remeshed) may
   * leave out slivers of it: points in these are warned of.
   * @return the warnings, "Goals/name/Point: ...".
   * @throws core::InputError for a point outside.
   */
  std::vector<std::string>
  check_goal_points(const scene::Scene &scene, const std::shared_ptr<const mesh::TetMesh> &mesh);
} // namespace tetradapt::estimate

#endif
