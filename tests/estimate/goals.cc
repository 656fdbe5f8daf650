// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Goals of known fields, and their errors, which the dual weighted residual finds
// where the next degree holds the displacement.

#include "tetradapt/estimate/goal_functional.h"
#include "tetradapt/estimate/goal_oriented.h"
#include "tetradapt/fem/replication.h"

#include "polynomials.h"

#include <deal.II/base/mpi.h>

#include <algorithm>

using namespace polynomials;
using scene::GoalType;

namespace
{
  bool first_rank = true;

  scene::GoalParameters
  make_goal(const std::string &name,
            const GoalType     type,
            const std::string &component,
            const std::string &weight = "1")
  {
    scene::GoalParameters goal;
    goal.name      = name;
    goal.type      = type;
    goal.component = component;
    goal.weight    = weight;
    goal.point     = Point<3>(0.4, 0.3, 0.6);
    goal.radius    = 0.25;
    if (type == GoalType::mean_displacement)
      goal.selector.where = "z > 1 - 1e-9";
    return goal;
  }

  /** A goal of a field that is given at the nodes, on a mesh that knows nothing of it. */
  double
  value_of(const scene::GoalParameters                         &goal,
           const unsigned int                                   degree,
           const std::function<Tensor<1, 3>(const Point<3> &)> &displacement,
           const std::vector<scene::LoadParameters>            &loads = {})
  {
    scene::Scene scene;
    scene.materials                      = {material("all", 1., 0.25)};
    scene.materials[0].thermal_expansion = 0.1;
    scene.goals                          = {goal};
    scene.loads                          = loads;
    const auto body                      = box(Point<3>(1, 1, 1), {{4, 4, 4}});
    select(*body, scene);
    const mechanics::MaterialMap materials(scene, *body);
    const auto                   field = std::make_shared<mesh::NodalField>(body, degree);
    for (unsigned int i = 0; i < field->n_nodes(); ++i)
      field->values[i] = displacement(field->node_position(i));
    estimate::Comparison comparison(fem::distribute(*field, MPI_COMM_WORLD),
                                    materials,
                                    scene.exact_solution,
                                    nullptr,
                                    MPI_COMM_WORLD);
    return estimate::evaluate_goals(scene, comparison).at(0).value;
  }

  void
  known_fields()
  {
    const auto check_value = [](const std::string &what, double value, double exact, double error) {
      if (first_rank)
        check(what, value, exact, 1., error);
    };
    const auto bent = [](const Point<3> &p) {
      return Tensor<1, 3>({p[0] * p[1], p[2] * p[2], p[0]});
    };
    check_value("displacement of a point",
                value_of(make_goal("g", GoalType::point_displacement, "y"), 2, bent),
                0.36,
                1e-12);
    check_value("mean displacement of a face",
                value_of(make_goal("g", GoalType::mean_displacement, "x", "x"), 2, bent),
                1. / 3.,
                1e-9);
    // s_xy = 0.4 x, s_xx = 0.4 (y + 2 y) = 1.2 y
    check_value("mean stress",
                value_of(make_goal("g", GoalType::mean_stress, "xy", "y + z"), 2, bent),
                0.2,
                1e-9);
    const std::string patch = "if(abs(x - 0.63) < 0.17 && abs(y - 0.5) < 0.21 && z > 0.71, 1, 0)";
    check_value("mean stress of a patch that the mesh does not know",
                value_of(make_goal("g", GoalType::mean_stress, "xx", patch), 2, bent),
                0.6,
                2e-4);
    check_value("stress of a point",
                value_of(make_goal("g", GoalType::point_stress, "xx"), 2, bent),
                0.36,
                2e-5);
    // At z = 0 only half of the ball is in the body: the mean of z is R 35/128.
    scene::GoalParameters half = make_goal("g", GoalType::point_stress, "yz");
    half.point                 = Point<3>(0.5, 0.5, 0.);
    check_value("the same at the boundary", // s_yz = 0.8 z
                value_of(half, 2, bent),
                0.8 * 0.25 * 35. / 128.,
                2e-5);
    scene::GoalParameters all = make_goal("g", GoalType::functional, "");
    all.displacement_weight   = {{"1", "z", "2"}};
    all.traction_weight       = {{"0", "0", "1"}};
    all.stress_weight         = {{"1", "0", "0", "x", "0", "0"}};
    // 1/4 + 1/4 + 1, x on all faces, 1.2 y + 0.4 x^2
    check_value("functional", value_of(all, 2, bent), 1.5 + 3. + 0.6 + 0.4 / 3., 1e-9);
    // Held back at 20 degrees with expansion 0.1: -(3 lambda + 2 mu) 2
    check_value("thermal stress",
                value_of(make_goal("g", GoalType::mean_stress, "zz"),
                         1,
                         [](const Point<3> &) { return Tensor<1, 3>(); },
                         {load("heat", scene::LoadType::temperature, "", {{"20", "0", "0"}})}),
                -4.,
                1e-12);
  }

  void
  refusals()
  {
    const auto refuse = [](const std::string &what, const scene::GoalParameters &goal) {
      try
        {
          value_of(goal, 1, [](const Point<3> &p) { return Tensor<1, 3>(p); });
          std::cout << "ACCEPTED\n";
        }
      catch (const core::InputError &error)
        {
          if (first_rank)
            std::cout << what << ": " << error.what() << '\n';
        }
    };
    scene::GoalParameters goal = make_goal("far", GoalType::point_displacement, "x");
    goal.point                 = Point<3>(2.5, 0.5, 0.5);
    refuse("point outside", goal);
    goal.type      = GoalType::point_stress;
    goal.component = "xx";
    refuse("ball outside", goal);
    refuse("no weight", make_goal("none", GoalType::mean_stress, "xx", "if(x > 3, 1, 0)"));
    refuse("not finite", make_goal("bad", GoalType::mean_stress, "xx", "1/max(0, x - 0.5)"));
  }

  /** Errors of goals against their estimates. */
  void
  estimates(const unsigned int degree)
  {
    scene::Scene scene   = make_scene(degree);
    scene.goals          = {make_goal("point", GoalType::point_displacement, "z"),
                            make_goal("face", GoalType::mean_displacement, "x"),
                            make_goal("stress", GoalType::mean_stress, "yz", "z^2")};
    scene.goals[0].exact = degree == 1 ? 0.12 : 0.048;
    scene.goals[1].exact = degree == 1 ? 5. / 6. : 0.25;
    scene.goals[2].exact = degree == 1 ? -0.4 : 1.3 / 3.;
    const Solved solved(scene, degree == 1 ? 6 : 4);
    const auto   values = estimate::evaluate_goals(scene, *solved.comparison);
    for (const auto &goal : values)
      {
        scene.estimation.goal = goal.name;
        const auto   estimate = solved(estimate::GoalOriented());
        const double index    = estimate.global / *goal.error;
        const double least
          = *std::min_element(estimate.indicators.begin(), estimate.indicators.end());
        if (!first_rank)
          continue;
        std::cout << "P" << degree << ", goal " << goal.name << ":\n";
        check("  there is an error, of 1e-6 to 1e-1",
              std::abs(*goal.error) > 1e-6 && std::abs(*goal.error) < 0.1);
        check("  estimated to 15 %", std::abs(index - 1.) < 0.15);
        check("  an indicator for every cell",
              estimate.indicators.size() == solved.body->n_cells() && least >= 0.);
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  known_fields();
  refusals();
  for (const unsigned int degree : {1, 2})
    estimates(degree);
}
