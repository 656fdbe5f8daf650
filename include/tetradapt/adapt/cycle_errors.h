// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_cycle_errors_h
#define tetradapt_adapt_cycle_errors_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/compare/reference.h"
#include "tetradapt/estimate/comparison.h"
#include "tetradapt/estimate/effectivity.h"
#include "tetradapt/scene/plan.h"

#include <string>

namespace tetradapt::adapt
{
  /** What a cycle's errors are measured with, beside the comparison. */
  struct ErrorSources
  {
    const scene::Scene       &scene;
    const scene::Plan        &plan;
    estimate::Drive           drive;
    const compare::Reference *reference; ///< null: none
  };

  struct MeasuredErrors
  {
    bool        true_energy_error = false; ///< CycleRecord::energy_error is the true one
    std::string warning;                   ///< empty, or one sentence
  };

  /**
   * Fills the errors of @p record as far as the plan needs them: against the
   * reference first, then, where they are known, by the known energy and against
   * the exact displacement; REN is the mean over the mesh's points, as in the 2015
   * report, whose elements were linear. Collective.
   *
   * @param energy a(u_h,u_h).
   */
  MeasuredErrors
  measure_errors(const ErrorSources   &sources,
                 double                energy,
                 estimate::Comparison &comparison,
                 CycleRecord          &record);
} // namespace tetradapt::adapt

#endif
