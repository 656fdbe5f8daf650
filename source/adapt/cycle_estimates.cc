// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/cycle_estimates.h"

#include "tetradapt/compare/root_of_squares.h"
#include "tetradapt/estimate/equilibrated/equilibrated.h"
#include "tetradapt/estimate/goal_functional.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tetradapt::adapt
{
  namespace
  {
    using scene::ErrorEstimator;
    using scene::Plan;

    bool
    is_driven(const scene::Plan &plan)
    {
      return plan.needs(Plan::marking) || plan.needs(Plan::sizing);
    }

    /** Estimators to run, the refinement indicator first. */
    std::vector<ErrorEstimator>
    wanted_estimators(const scene::Scene &scene, const bool driven)
    {
      std::vector<ErrorEstimator> wanted;
      if (driven)
        wanted.push_back(scene.adaptivity.refinement_indicator);
      for (const ErrorEstimator which : scene.estimation.estimators)
        if (std::find(wanted.begin(), wanted.end(), which) == wanted.end())
          wanted.push_back(which);
      return wanted;
    }

    /** Takes what errors leave out from an estimate. Global values of comparisons do not have it.
     */
    void
    leave_out(const estimate::Comparison      &comparison,
              const estimate::EstimatorTraits &traits,
              estimate::Estimate              &estimate)
    {
      const compare::ExcludedRegion &excluded = comparison.excluded_region();
      if (excluded.empty())
        return;
      excluded.clear(comparison.mesh(), estimate.indicators);
      if (traits.is_energy_norm && !traits.needs_reference && !traits.needs_exact_displacement
          && !estimate.indicators.empty())
        estimate.global = compare::root_of_squares(estimate.indicators);
    }

    EstimateRecord
    to_record(const estimate::EstimatorTraits &traits,
              const estimate::Estimate        &estimate,
              const mechanics::EnergyNorm     &norm,
              const KnownError                &known)
    {
      EstimateRecord record;
      record.name           = traits.name;
      record.is_energy_norm = traits.is_energy_norm;
      record.global         = estimate.global;
      if (!traits.is_energy_norm)
        return record;
      record.relative    = norm.relative(estimate.global);
      record.effectivity = estimate::effectivity(record.global, known.global);
      if (known.cells != nullptr && estimate.indicators.size() == known.cells->size())
        record.local_deviation = deviation_of_local_effectivity(estimate.indicators, *known.cells);
      return record;
    }

    /** The norm that the record's relative error is of, so that curves of estimates and
     * errors can be compared; that of the solution where there is none. */
    mechanics::EnergyNorm
    norm_of_solution(const CycleRecord &record, const solve::StaticSolution &solution)
    {
      mechanics::EnergyNorm norm = solution.norm;
      if (record.energy_error && record.relative_energy_error.value_or(0.) > 0.)
        norm.value = *record.energy_error / *record.relative_energy_error;
      return norm;
    }

    /** Adds to the refinement indicator what it does not see of the loads. An indicator that is
     * no energy norm is scaled as if its norm were the energy error against the reference, or a
     * tenth of the solution's norm without a reference; it stays as it is where it is zero. */
    void
    add_oscillations(const ErrorSources              &sources,
                     const SolvedCycle               &cycle,
                     const estimate::EstimatorTraits &traits,
                     const CycleRecord               &record,
                     std::vector<double>             &indicators)
    {
      const std::vector<double> oscillations
        = estimate::load_oscillations(cycle.comparison.displacement(),
                                      sources.scene,
                                      cycle.comparison.material_map(),
                                      cycle.comparison.mpi_communicator());
      if (oscillations.empty() || indicators.empty())
        return;
      double factor = 1.;
      if (!traits.is_energy_norm)
        {
          const double energy = record.estimate.value_or(0.1 * cycle.solution.norm.value);
          if (!(energy > 0.))
            return;
          factor = compare::root_of_squares(indicators) / energy;
        }
      for (std::size_t cell = 0; cell < indicators.size(); ++cell)
        indicators[cell] = std::hypot(indicators[cell], factor * oscillations[cell]);
    }
  } // namespace

  bool
  any_estimator(const scene::Scene &scene,
                const scene::Plan  &plan,
                bool estimate::EstimatorTraits::*trait)
  {
    for (const ErrorEstimator which : wanted_estimators(scene, is_driven(plan)))
      if (estimate::make_estimator(which)->traits().*trait)
        return true;
    return false;
  }

  void
  evaluate_goals(const scene::Scene &scene, estimate::Comparison &comparison, CycleRecord &record)
  {
    for (const auto &goal : estimate::evaluate_goals(scene, comparison))
      {
        GoalRecord entry;
        entry.name         = goal.name;
        entry.value        = goal.value;
        entry.exact        = goal.exact;
        entry.error        = goal.error;
        const bool is_main = scene.estimation.goal.empty() ? record.goals.empty()
                                                           : goal.name == scene.estimation.goal;
        for (const EstimateRecord &estimate : record.estimates)
          if (is_main && estimate.which == ErrorEstimator::goal)
            {
              entry.error_estimate = estimate.global;
              entry.effectivity    = estimate::effectivity(estimate.global, goal.error);
            }
        record.goals.push_back(entry);
      }
  }

  std::optional<double>
  deviation_of_local_effectivity(const std::vector<double> &indicators,
                                 const std::vector<double> &errors)
  {
    double weight = 0., mean = 0., square = 0.;
    for (std::size_t cell = 0; cell < errors.size(); ++cell)
      {
        if (!(indicators[cell] > 0.) || !(errors[cell] > 0.))
          continue;
        const double w      = errors[cell] * errors[cell];
        const double value  = std::log(indicators[cell] / errors[cell]);
        const double change = value - mean;
        // Welford's update: the plain difference of squares loses digits.
        weight += w;
        mean += change * w / weight;
        square += w * change * (value - mean);
      }
    if (weight == 0.)
      return std::nullopt;
    return std::sqrt(square / weight);
  }

  std::vector<double>
  run_estimators(const ErrorSources &sources,
                 const SolvedCycle  &cycle,
                 const KnownError   &known,
                 CycleRecord        &record)
  {
    using Clock                = std::chrono::steady_clock;
    const bool          driven = is_driven(sources.plan);
    const auto          norm   = norm_of_solution(record, cycle.solution);
    std::vector<double> indicators;
    for (const ErrorEstimator which : wanted_estimators(sources.scene, driven))
      {
        const auto start     = Clock::now();
        const auto estimator = estimate::make_estimator(which);
        auto       estimate
          = estimator->estimate({cycle.comparison, sources.scene, cycle.solution, cycle.levels});
        leave_out(cycle.comparison, estimator->traits(), estimate);
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        const bool   drives  = driven && which == sources.scene.adaptivity.refinement_indicator;
        if (drives)
          {
            indicators = estimate.indicators;
            add_oscillations(sources, cycle, estimator->traits(), record, indicators);
            cycle.comparison.excluded_region().continue_into(cycle.comparison.mesh(), indicators);
          }
        if (estimate.missing)
          continue;
        KnownError comparable = known.source == which ? KnownError() : known;
        if (known.cells_source == which)
          comparable.cells = nullptr;
        record.estimates.push_back(to_record(estimator->traits(), estimate, norm, comparable));
        record.estimates.back().which   = which;
        record.estimates.back().seconds = seconds;
      }
    return indicators;
  }
} // namespace tetradapt::adapt
