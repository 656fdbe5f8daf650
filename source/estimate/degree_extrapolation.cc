// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/enriched/enriched_problem.h"
#include "tetradapt/estimate/extrapolation.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    /** Of the energy norm of the difference. What is missing enters as the root of the
     * sum of squares and is estimated itself. */
    constexpr double tolerance = 0.15;
  } // namespace

  EstimatorTraits
  DegreeExtrapolation::traits() const
  {
    EstimatorTraits traits;
    traits.name          = "degree extrapolation";
    traits.documentation = "Energy norm of the difference to the solution of the next degree on "
                           "the same mesh, which is solved for on the whole mesh, to the digits "
                           "that an estimate needs.";
    traits.needs_system  = true;
    return traits;
  }

  Estimate
  DegreeExtrapolation::estimate(const EstimateInput &input) const
  {
    const EnrichedProblem       problem(input);
    const EnrichedSpace::Values supported  = problem.supported_solution();
    EnrichedProblem::Correction correction = problem.solve(problem.residual(supported), tolerance);
    // What the supports prescribe beyond the solution's degree is part of the difference.
    EnrichedSpace::Values &difference = correction.values;
    for (std::size_t i = 3 * problem.space().n_nodes(); i < difference.size(); ++i)
      difference[i] += supported[i];

    Estimate result;
    result.indicators = problem.space().cell_products(difference, difference);
    double squares    = 0.;
    for (double &indicator : result.indicators)
      {
        indicator = std::max(indicator, 0.) * (1. + correction.missing);
        squares += indicator;
        indicator = std::sqrt(indicator);
      }
    result.global = std::sqrt(squares);
    return result;
  }
} // namespace tetradapt::estimate
