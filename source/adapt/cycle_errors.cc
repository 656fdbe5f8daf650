// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/cycle_errors.h"

namespace tetradapt::adapt
{
  namespace
  {
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
  } // namespace

  MeasuredErrors
  measure_errors(const ErrorSources   &sources,
                 double                energy,
                 estimate::Comparison &comparison,
                 CycleRecord          &record)
  {
    const Plan    &plan = sources.plan;
    MeasuredErrors measured;
    if (plan.needs(Plan::extrapolation))
      {
        const compare::Difference &difference = comparison.to_reference();
        set_errors(difference, record);
        record.estimate          = difference.energy;
        record.relative_estimate = record.relative_energy_error;
        record.reference_error = ratio(sources.reference->estimated_error, difference.energy_norm);
      }
    if (plan.needs(Plan::known_energy))
      {
        const auto known
          = estimate::error_from_known_energy(sources.scene.truth.energy, energy, sources.drive);
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
        set_errors(comparison.to_truth(), record);
        measured.true_energy_error = true;
      }
    if (measured.true_energy_error)
      record.effectivity = estimate::effectivity(record.estimate, record.energy_error);
    if (plan.needs(Plan::nodal_ren))
      {
        const compare::NodalRen &ren = comparison.ren();
        record.mean_ren              = ren.mean_of_points;
        record.max_ren               = ren.max;
      }
    return measured;
  }
} // namespace tetradapt::adapt
