// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/cycle_errors.h"

#include "tetradapt/adapt/cycle_estimates.h"
#include "tetradapt/adapt/stopping.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::adapt
{
  namespace
  {
    using scene::ErrorEstimator;
    using scene::Plan;

    using mechanics::EnergyNorm;

    std::optional<double>
    ratio(double value, double scale)
    {
      return scale > 0. ? std::optional<double>(value / scale) : std::nullopt;
    }

    /** The norm of what a solution is compared with; its noise that of both. */
    EnergyNorm
    norm_of(const compare::Difference &difference, const EnergyNorm &own)
    {
      return {difference.energy_norm, std::max(difference.energy_noise, own.noise)};
    }

    /** Puts the norms of a difference in the record, as absolute and relative errors. */
    void
    set_errors(const compare::Difference &difference, const EnergyNorm &norm, CycleRecord &record)
    {
      record.l2_error              = difference.l2;
      record.h1_error              = difference.h1;
      record.energy_error          = difference.energy;
      record.relative_l2_error     = ratio(difference.l2, difference.l2_norm);
      record.relative_h1_error     = ratio(difference.h1, difference.h1_norm);
      record.relative_energy_error = norm.relative(difference.energy);
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
          const EnergyNorm           norm       = norm_of(difference, cycle.solution.norm);
          set_errors(difference, norm, record);
          record.error_source             = ErrorSource::reference;
          record.estimate                 = difference.energy;
          record.relative_estimate        = record.relative_energy_error;
          record.estimate_source          = "reference";
          record.reference_error_estimate = norm.relative(sources.reference->estimated_error);
        }
      if (plan.needs(Plan::known_energy))
        {
          const auto known
            = estimate::error_from_strain_energy(sources.scene.exact_solution.strain_energy,
                                                 cycle.solution.strain_energy,
                                                 estimate::strain_energy_side(sources.scene));
          measured.warning = known.warning;
          if (known.error)
            {
              record.energy_error          = known.error;
              record.relative_energy_error = known.relative_error;
              record.error_source          = ErrorSource::known_energy;
            }
        }
      if (plan.needs(Plan::exact_comparison))
        {
          const compare::Difference &difference = cycle.comparison.to_exact_solution();
          set_errors(difference, norm_of(difference, cycle.solution.norm), record);
          record.error_source = ErrorSource::exact;
          if (!record.relative_energy_error)
            measured.warning = "The exact solution has no stress, so that no relative error can "
                               "be told: only the absolute errors mean something.";
        }
      if (record.l2_error || plan.needs(Plan::nodal_ren))
        record.displacement_error_source = sources.scene.exact_solution.has_displacement()
                                             ? ErrorSource::exact
                                             : ErrorSource::reference;
    }

    /** What effectivities are measured against: the exact solution, else a reference that is
     * clearly better than the mesh. */
    KnownError
    known_error(const ErrorSources &sources, const SolvedCycle &cycle, const CycleRecord &record)
    {
      KnownError known;
      // What is lost in rounding cannot be estimated.
      if (is_true(record.error_source) && record.energy_error > cycle.solution.norm.noise)
        known.global = record.energy_error;
      if (sources.plan.needs(Plan::exact_comparison))
        {
          known.cells        = &cycle.comparison.to_exact_solution().cell_energy;
          known.cells_source = ErrorEstimator::exact;
          known.source       = ErrorEstimator::exact;
        }
      else if (sources.plan.needs(Plan::extrapolation)
               && reference_trust(record.reference_error_estimate, record.relative_estimate)
                    == ReferenceTrust::trusted)
        {
          known.cells        = &cycle.comparison.to_reference().cell_energy;
          known.cells_source = ErrorEstimator::energy;
          if (!is_true(record.error_source))
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

    /** Without a reference, the first estimator of the energy norm gives the estimate. */
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
            record.estimate_source   = estimate.name;
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
      if (adaptivity.refinement_indicator == ErrorEstimator::goal)
        {
          for (const GoalRecord &goal : record.goals)
            if (adaptivity.goal_tolerance > 0. && goal.error_estimate && *goal.error_estimate != 0.)
              return std::sqrt(squares * adaptivity.goal_tolerance
                               * std::abs(goal.value / *goal.error_estimate));
          return 0.;
        }
      if (tolerance == 0. || adaptivity.refinement_indicator == ErrorEstimator::ren
          || relative_error_or_estimate(record).value_or(0.) == 0.)
        return 0.;
      double wanted = tolerance;
      if (!is_true(record.error_source))
        {
          // The reference's own error is part of what the user is told.
          const double own = record.reference_error_estimate.value_or(0.);
          if (own >= tolerance)
            return 0.;
          wanted = std::sqrt(tolerance * tolerance - own * own);
        }
      // Whatever the estimator's effectivity, the error falls as the indicators do.
      return std::sqrt(squares) * wanted / *relative_error_or_estimate(record);
    }
  } // namespace

  MeasuredErrors
  measure_errors(const ErrorSources &sources, const SolvedCycle &cycle, CycleRecord &record)
  {
    MeasuredErrors measured;
    compare_solutions(sources, cycle, record, measured);
    measured.indicators
      = run_estimators(sources, cycle, known_error(sources, cycle, record), record);
    if (sources.plan.needs(Plan::goal_values))
      evaluate_goals(sources.scene, cycle.comparison, record);
    set_main_estimate(record);
    if (is_true(record.error_source) && record.energy_error > cycle.solution.norm.noise)
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
