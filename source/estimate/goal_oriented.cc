// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/goal_oriented.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/estimate/enriched/enriched_problem.h"
#include "tetradapt/estimate/goal_functional.h"
#include "tetradapt/fem/replication.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tetradapt::estimate
{
  namespace
  {
    using Values = EnrichedSpace::Values;

    constexpr double dual_accuracy       = 1e-3; ///< of the dual solution, energy norm
    constexpr double correction_accuracy = 0.1;  ///< of both corrections at first, energy norm
    constexpr double best_accuracy       = 1e-3; ///< that they are driven to where it takes that
    /** What the product of both corrections' errors may be of the goal's error; what is really
     * missing was about an eighth of that product in the cases tried. */
    constexpr double most_product = 0.5, wanted_product = 0.1;
    constexpr double least_cosine = 0.05; ///< of the corrections' angle in a cell

    const scene::GoalParameters &
    chosen_goal(const scene::Scene &scene)
    {
      for (const auto &goal : scene.goals)
        if (scene.estimation.goal.empty() || goal.name == scene.estimation.goal)
          return goal;
      throw core::InputError("Estimation/Goal: there is no goal '" + scene.estimation.goal
                             + "'. Add a subsection to Goals, or name one that is there.");
    }

    /** Sum of the products of entries from @p begin to @p end. */
    double
    product(const Values &a, const Values &b, std::size_t begin, std::size_t end)
    {
      double sum = 0.;
      for (std::size_t i = begin; i < end; ++i)
        sum += a[i] * b[i];
      return sum;
    }

    std::vector<Tensor<1, 3>>
    nodal_part(const Values &values, unsigned int n_nodes)
    {
      std::vector<Tensor<1, 3>> result(n_nodes);
      for (std::size_t i = 0; i < n_nodes; ++i)
        result[i] = Tensor<1, 3>({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
      return result;
    }

    double
    sum(const std::vector<double> &values)
    {
      return std::accumulate(values.begin(), values.end(), 0.);
    }

    /** Goes on with a correction until its error is @p tolerance times its norm. */
    void
    improve(const EnrichedProblem       &problem,
            const Values                &forces,
            double                       tolerance,
            EnrichedProblem::Correction &correction)
    {
      if (correction.error <= tolerance * correction.norm)
        return;
      Values rest;
      problem.space().multiply(correction.values, rest);
      rest.sadd(-1., 1., forces);
      problem.clear_supported(rest);
      const double norm = correction.norm;
      const auto   more = problem.solve(rest, std::min(0.5, tolerance * norm / correction.error));
      correction.values += more.values;
      correction.norm  = std::hypot(norm, more.norm);
      correction.error = more.error;
    }

    /** a_K(x, y) on every cell, with the springs there. */
    std::vector<double>
    products(const EnrichedSpace &space, const Values &x, const Values &y)
    {
      std::vector<double> result = space.cell_products(x, y);
      space.add_spring_products(x, y, result);
      return result;
    }

    /** See the class. */
    std::vector<double>
    indicators(const EnrichedSpace &space, const Values &e_u, const Values &e_z)
    {
      std::vector<double> result = products(space, e_u, e_z);
      const auto          primal = products(space, e_u, e_u);
      const auto          dual   = products(space, e_z, e_z);
      for (std::size_t cell = 0; cell < result.size(); ++cell)
        {
          const double bound = std::sqrt(std::max(primal[cell] * dual[cell], 0.));
          result[cell]       = std::sqrt(std::max(std::abs(result[cell]), least_cosine * bound));
        }
      return result;
    }
  } // namespace

  EstimatorTraits
  GoalOriented::traits() const
  {
    EstimatorTraits traits;
    traits.name           = "goal";
    traits.documentation  = "Error of a goal by the dual weighted residual: dual solution on the "
                            "same mesh, both solutions corrected to the next degree.";
    traits.needs_system   = true;
    traits.is_energy_norm = false;
    return traits;
  }

  Estimate
  GoalOriented::estimate(const EstimateInput &input) const
  {
    const EnrichedProblem problem(input);
    const EnrichedSpace  &space = problem.space();
    const std::size_t     nodal = 3 * static_cast<std::size_t>(space.n_nodes()), all = space.size();

    const auto goal_forces = put_on_mesh(chosen_goal(input.scene),
                                         input.comparison.displacement(),
                                         input.comparison,
                                         &space.surplus())
                               .forces;
    const Values              goal(goal_forces.begin(), goal_forces.end());
    solve::StaticSystem::Stop stop;
    if (input.scene.solver.stopping == scene::SolverParameters::Stopping::discretisation)
      stop.relative_error = dual_accuracy;
    const solve::StaticSystem &system = *input.solution.system;
    const auto                 z
      = system.solve_dual(fem::distribute(*system.space(), nodal_part(goal, space.n_nodes())),
                          stop);
    const Values z_h = space.embed(fem::replicate(z->space(), z->vector()));
    Values       dual_residual;
    space.multiply(z_h, dual_residual);
    dual_residual.sadd(-1., 1., goal);
    problem.clear_supported(dual_residual);

    const Values supported = problem.supported_solution();
    const Values residual  = problem.residual(supported);
    auto         e_u       = problem.solve(residual, correction_accuracy);
    auto         e_z       = problem.solve(dual_residual, correction_accuracy);

    // What is prescribed beyond degree p, and what the solver left.
    const double direct = product(goal, supported, nodal, all) + product(residual, z_h, 0, nodal);
    const auto   global = [&]() {
      return direct + product(residual, e_z.values, 0, all)
             + product(dual_residual, e_u.values, 0, all)
             - sum(products(space, e_u.values, e_z.values));
    };
    Estimate result;
    result.global = global();
    // Where contributions cancel, the error of the goal is far below |||e_u||| |||e_z|||.
    const double size = std::abs(result.global);
    if (e_u.error * e_z.error > most_product * size)
      {
        const double accuracy
          = std::max(best_accuracy, std::sqrt(wanted_product * size / (e_u.norm * e_z.norm)));
        improve(problem, residual, accuracy, e_u);
        improve(problem, dual_residual, accuracy, e_z);
        result.global = global();
      }

    for (std::size_t i = nodal; i < all; ++i)
      e_u.values[i] += supported[i];
    result.indicators = indicators(space, e_u.values, e_z.values);
    return result;
  }
} // namespace tetradapt::estimate
