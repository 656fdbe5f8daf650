// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_cycle_errors_h
#define tetradapt_adapt_cycle_errors_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/compare/reference.h"
#include "tetradapt/estimate/effectivity.h"
#include "tetradapt/estimate/estimator.h"
#include "tetradapt/scene/plan.h"

#include <string>
#include <vector>

namespace tetradapt::adapt
{
  /** What a cycle's errors are measured with, apart from the comparison. */
  struct ErrorSources
  {
    const scene::Scene       &scene;
    const scene::Plan        &plan;
    estimate::Drive           drive;
    const compare::Reference *reference; ///< null: none
  };

  /** One cycle's solution and what is known from the cycles before. */
  struct SolvedCycle
  {
    const solve::StaticSolution              &solution;
    estimate::Comparison                     &comparison;
    const std::vector<estimate::EnergyLevel> &levels; ///< of all cycles, this one last
  };

  struct MeasuredErrors
  {
    std::string warning; ///< empty, or one sentence
    /** Of the refinement indicator, one a cell; empty if nothing is to be refined. */
    std::vector<double> indicators;
    /** The root of the sum of the squared indicators that would reach the scene's
     * tolerance; 0: there is none that the indicators know of. */
    double wanted_indicator_norm = 0.;
  };

  /**
   * Fills the errors, the estimates and the goals of @p record as far as the plan
   * needs them: against the reference first, then, where they are known, by the known energy and
   * against the exact displacement; REN is the mean over the mesh's points, as in the 2015
   * report, whose elements were linear. Collective.
   */
  MeasuredErrors
  measure_errors(const ErrorSources &sources, const SolvedCycle &cycle, CycleRecord &record);
} // namespace tetradapt::adapt

#endif
