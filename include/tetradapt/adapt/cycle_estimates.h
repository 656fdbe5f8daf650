// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_cycle_estimates_h
#define tetradapt_adapt_cycle_estimates_h

#include "tetradapt/adapt/cycle_errors.h"

#include <optional>

namespace tetradapt::adapt
{
  /** The error as it is known without any estimator, for effectivities. */
  struct KnownError
  {
    std::optional<double>      global;          ///< energy norm
    const std::vector<double> *cells = nullptr; ///< energy norm, one a cell, or null
    /** The estimators that made them, for which an effectivity would say nothing. */
    std::optional<scene::ErrorEstimator> source, cells_source;
  };

  /**
   * Runs the scene's estimators, the refinement indicator first, and fills record.estimates.
   * @return the refinement indicator's values; empty if nothing drives.
   */
  std::vector<double>
  run_estimators(const ErrorSources &sources,
                 const SolvedCycle  &cycle,
                 const KnownError   &known,
                 CycleRecord        &record);

  /** Whether one of the scene's estimators has @p trait: EstimatorTraits::needs_system, for one. */
  bool
  any_estimator(const scene::Scene &scene,
                const scene::Plan  &plan,
                bool estimate::EstimatorTraits::*trait);

  /** Evaluates the goals into record.goals, with what the estimator 'goal' said of
   * its own. To be called after run_estimators(). Collective. */
  void
  evaluate_goals(const scene::Scene &scene, estimate::Comparison &comparison, CycleRecord &record);

  /**
   * How unevenly indicators follow the true local errors: the standard deviation of
   * ln(eta_K / e_K), cells weighted by e_K^2. Cells where either is zero are left out;
   * empty if none is left.
   */
  std::optional<double>
  deviation_of_local_effectivity(const std::vector<double> &indicators,
                                 const std::vector<double> &errors);
} // namespace tetradapt::adapt

#endif
