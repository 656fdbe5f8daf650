// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_goal_functional_h
#define tetradapt_estimate_goal_functional_h

#include "tetradapt/compare/point_locator.h"
#include "tetradapt/estimate/comparison.h"
#include "tetradapt/estimate/hierarchical_surplus.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::estimate
{
  /** A goal on one mesh: J(u) = sum_i forces_i . u_i + offset. */
  struct GoalFunctional
  {
    /** J(phi_i), three a function: of the nodes, and then of the surplus where one was
     * given. What a dual problem is loaded with; whole on every rank. */
    std::vector<double> forces;
    /** What no displacement changes: the stress that the thermal strain takes away. */
    double offset = 0.;

    /** J of a field that has the nodes' values, whatever its surplus. */
    double
    value(const mesh::NodalField &field) const;
  };

  /**
   * Puts a goal on the mesh of @p field. Collective.
   *
   * Stresses are C : (strain - thermal strain) inside the cells. Weights and the kernel
   * of a point stress are integrated adaptively, to 1e-6 of their integral in every part.
   * A patch much smaller than 1/16 of the body's diagonal may be missed on a coarse
   * mesh. Means are over the part of a
   * ball that lies in the body, and are divided by the weight's integral with the same
   * points, so that the mean of a constant is exact.
   *
   * @param comparison whose locator finds a goal's point.
   * @param surplus of the field, if its forces are wanted, too; else null.
   * @throws core::InputError if a point lies outside of the body, a weight's integral is
   *         not positive, or an expression is wrong.
   */
  GoalFunctional
  put_on_mesh(const scene::GoalParameters &goal,
              const mesh::NodalField      &field,
              Comparison                  &comparison,
              const HierarchicalSurplus   *surplus = nullptr);

  /** A goal's value for a solution. */
  struct GoalValue
  {
    std::string           name;
    double                value = 0.;
    std::optional<double> exact; ///< as the scene gives it
    std::optional<double> error; ///< exact - value
  };

  /** The values of all goals of @p scene for the comparison's displacement. Collective.
   * @throws core::InputError as put_on_mesh(). */
  std::vector<GoalValue>
  evaluate_goals(const scene::Scene &scene, Comparison &comparison);
} // namespace tetradapt::estimate

#endif
