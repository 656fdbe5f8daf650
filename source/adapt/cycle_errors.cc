// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/cycle_errors.h"

#include "tetradapt/adapt/cycle_estimates.h"
#include "tetradapt/adapt/stopping.h"

#include <cmath>

namespace tetradapt::adapt
{
  namespace
  {
    using scene::ErrorEstimator;
    using scene::Plan;

    std::optional<double>
    ratio(double value, double scale)
    {
      return scale > 0. ? std::optional<double>(value / scale) : std::nullopt;
    }

    /** Puts the norms of a difference in the record, as absolute and relative errors. */
    void
    set_errors(const compare::Difference &difference, CycleRecord &record)
    {
      record.l2_error              = difference.l2;
      record.h1_error              = difference.h1;
      record.energy_error          = difference.energy;
      record.relative_l2_error     = ratio(difference.l2, difference.l2_norm);
      record.relative_h1_error     = ratio(difference.h1, difference.h1_norm);
      record.relative_energy_error = ratio(difference.energy, difference.energy_norm);
    }

    /** Errors against the reference, the known energy and the exact displacement, the
     * later ones in place of the earlier ones. */
    void
    compare_solutions(const ErrorSources &sources,
                      const SolvedCycle  &cycle,
                      CycleRecord        &record,
                      MeasuredErrors     &measured)
    {
      const Plan &plan = sources.plan;
      if (plan.needs(Plan::extrapolation))
        {
          const compare::Difference &difference = cycle.comparison.to_reference();
          set_errors(difference, record);
          record.estimate          = difference.energy;
          record.relative_estimate = record.relative_energy_error;
          record.reference_error
            = ratio(sources.reference->estimated_error, difference.energy_norm);
        }
      if (plan.needs(Plan::known_energy))
        {
          const auto known = estimate::error_from_known_energy(sources.scene.truth.energy,
                                                               cycle.solution.energy,
                                                               sources.drive);
          measured.warning = known.warning;
          if (known.error)
            {
              record.energy_error          = known.error;
              record.relative_energy_error = known.relative_error;
              measured.true_energy_error   = true;
            }
        }
      if (plan.needs(Plan::exact_comparison))
        {
          set_errors(cycle.comparison.to_truth(), record);
          measured.true_energy_error = true;
        }
    }

    /** What effectivities are measured against: the truth, else a reference that is
     * clearly better than the mesh. */
    KnownError
    known_error(const ErrorSources   &sources,
                const SolvedCycle    &cycle,
                const CycleRecord    &record,
                const MeasuredErrors &measured)
    {
      KnownError known;
      if (measured.true_energy_error)
        known.global = record.energy_error;
      if (sources.plan.needs(Plan::exact_comparison))
        {
          known.cells        = &cycle.comparison.to_truth().cell_energy;
          known.cells_source = ErrorEstimator::exact;
          known.source       = ErrorEstimator::exact;
        }
      else if (sources.plan.needs(Plan::extrapolation)
               && reference_trust(record.reference_error, record.relative_estimate)
                    == ReferenceTrust::trusted)
        {
          known.cells        = &cycle.comparison.to_reference().cell_energy;
          known.cells_source = ErrorEstimator::energy;
          if (!measured.true_energy_error)
            {
              known.global = record.estimate;
              known.source = ErrorEstimator::energy;
              if (sources.reference->known_energy)
                {
                  // Extrapolated over the reference's own meshes: nearer than the finest.
                  const auto sharper
                    = estimate::error_from_known_energy(*sources.reference->known_energy,
                                                        cycle.solution.energy,
                                                        sources.drive);
                  if (sharper.error)
                    known.global = sharper.error;
                }
            }
        }
      return known;
    }

    /** Lets an estimator of the energy norm stand for the error where nothing better
     * is known. */
    void
    set_main_estimate(CycleRecord &record)
    {
      if (record.estimate)
        return;
      for (const EstimateRecord &estimate : record.estimates)
        if (estimate.is_energy_norm)
          {
            record.estimate          = estimate.global;
            record.relative_estimate = estimate.relative;
            if (!record.energy_error)
              {
                record.energy_error          = record.estimate;
                record.relative_energy_error = record.relative_estimate;
              }
            return;
          }
    }

    double
    wanted_indicator_norm(const scene::Scene   &scene,
                          const CycleRecord    &record,
                          const MeasuredErrors &measured)
    {
      double squares = 0.;
      for (const double indicator : measured.indicators)
        squares += indicator * indicator;
      const auto  &adaptivity = scene.adaptivity;
      const double tolerance  = adaptivity.tolerance;
      if (adaptivity.driver == ErrorEstimator::goal)
        {
          for (const GoalRecord &goal : record.goals)
            if (adaptivity.goal_tolerance > 0. && goal.estimated_error
                && *goal.estimated_error != 0.)
              return std::sqrt(squares * adaptivity.goal_tolerance
                               * std::abs(goal.value / *goal.estimated_error));
          return 0.;
        }
      if (tolerance == 0. || adaptivity.driver == ErrorEstimator::ren
          || record.relative_energy_error.value_or(0.) == 0.)
        return 0.;
      double wanted = tolerance;
      if (!measured.true_energy_error)
        {
          // The reference's own error is part of what the user is told.
          const double own = record.reference_error.value_or(0.);
          if (own >= tolerance)
            return 0.;
          wanted = std::sqrt(tolerance * tolerance - own * own);
        }
      // Whatever the estimator's effectivity, the error falls as the indicators do.
      return std::sqrt(squares) * wanted / *record.relative_energy_error;
    }
  } // namespace

  MeasuredErrors
  measure_errors(const ErrorSources &sources, const SolvedCycle &cycle, CycleRecord &record)
  {
    MeasuredErrors measured;
    compare_solutions(sources, cycle, record, measured);
    measured.indicators
      = run_estimators(sources, cycle, known_error(sources, cycle, record, measured), record);
    if (sources.plan.needs(Plan::goal_values))
      evaluate_goals(sources.scene, cycle.comparison, record);
    set_main_estimate(record);
    record.true_energy_error = measured.true_energy_error;
    if (measured.true_energy_error)
      record.effectivity = estimate::effectivity(record.estimate, record.energy_error);
    measured.wanted_indicator_norm = wanted_indicator_norm(sources.scene, record, measured);
    if (sources.plan.needs(Plan::nodal_ren))
      {
        const compare::NodalRen &ren = cycle.comparison.ren();
        record.mean_ren              = ren.mean_of_points;
        record.max_ren               = ren.max;
      }
    return measured;
  }
} // namespace tetradapt::adapt
