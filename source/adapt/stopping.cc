// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/stopping.h"

#include <cmath>
#include <sstream>

namespace tetradapt::adapt
{
  using scene::AdaptivityParameters;
  using Strategy = AdaptivityParameters::Strategy;

  namespace
  {
    std::string
    number(const double value)
    {
      std::ostringstream text;
      text.precision(3);
      text << value;
      return text.str();
    }



    /** The relative energy error of a cycle as well as it is known, and how it is
     * called. */
    struct MeasuredError
    {
      std::optional<double> value;
      std::string           name;
    };



    MeasuredError
    measured_error(const StoppingContext &context, const CycleRecord &record)
    {
      if (context.true_energy_error && record.relative_energy_error)
        return {record.relative_energy_error, "true relative energy error"};
      if (!record.relative_estimate)
        return {};
      if (!record.reference_error_estimate)
        return {record.relative_estimate, "estimated relative energy error"};
      return {std::hypot(*record.relative_estimate, *record.reference_error_estimate),
              "estimated relative energy error (the reference's own error of "
                + number(*record.reference_error_estimate) + " included)"};
    }



    ReferenceTrust
    trust_of(const StoppingContext &context, const CycleRecord &record)
    {
      if (context.reference_tets == 0)
        return ReferenceTrust::unknown;
      return reference_trust(record.reference_error_estimate,
                             context.true_energy_error && record.relative_energy_error
                               ? record.relative_energy_error
                               : record.relative_estimate);
    }



    /** Whether the figures of this scene's table hang on the reference. */
    bool
    measured_with_reference(const StoppingContext &context)
    {
      return context.reference_tets > 0 && !context.true_energy_error;
    }



    /** The reference's error compared with the mesh's, as half a sentence. */
    std::string
    compared_errors(const StoppingContext &context, const CycleRecord &record)
    {
      const bool is_true = context.true_energy_error && record.relative_energy_error;
      return "its own relative energy error is " + number(*record.reference_error_estimate)
             + (is_true ? ", the true error of this mesh " : ", its difference to this mesh ")
             + number(is_true ? *record.relative_energy_error : *record.relative_estimate);
    }



    /** The relative error of the goal that a tolerance is about, true if its value is known, else
     * as the estimator 'goal' says. */
    std::optional<double>
    relative_goal_error(const StoppingContext &context, const CycleRecord &record)
    {
      for (const GoalRecord &goal : record.goals)
        if (context.goal.empty() || goal.name == context.goal)
          {
            if (goal.error && *goal.exact != 0.)
              return std::abs(*goal.error / *goal.exact);
            if (goal.error_estimate && goal.value != 0.)
              return std::abs(*goal.error_estimate / goal.value);
            break;
          }
      return std::nullopt;
    }



    bool
    any_tolerance(const AdaptivityParameters &parameters)
    {
      return parameters.tolerance > 0. || parameters.ren_tolerance > 0.
             || parameters.goal_tolerance > 0.;
    }



    /** Fills reason and text if every tolerance that is set is reached. */
    void
    check_tolerances(const AdaptivityParameters &parameters,
                     const StoppingContext      &context,
                     const CycleRecord          &record,
                     const ReferenceTrust        trust,
                     StopDecision               &decision)
    {
      const bool energy_wanted = parameters.tolerance > 0.;
      const bool ren_wanted    = parameters.ren_tolerance > 0.;
      if (!any_tolerance(parameters))
        return;

      std::string text;
      const auto  add = [&text](const std::string &what) {
        text += (text.empty() ? "Tolerance reached: " : "; ") + what;
      };
      if (energy_wanted)
        {
          const MeasuredError error = measured_error(context, record);
          if (!error.value || !(*error.value <= parameters.tolerance))
            return;
          // The figure includes the reference's error, but a figure that is mostly
          // the reference's error says nothing about the mesh.
          if (!context.true_energy_error && trust == ReferenceTrust::saturated)
            return;
          add("the " + error.name + " is " + number(*error.value) + ", at most "
              + number(parameters.tolerance));
        }
      if (ren_wanted)
        {
          if (!record.mean_ren || !(*record.mean_ren <= parameters.ren_tolerance))
            return;
          if (!context.true_ren && trust == ReferenceTrust::saturated)
            return;
          add("the mean REN is " + number(*record.mean_ren) + ", at most "
              + number(parameters.ren_tolerance));
        }
      if (parameters.goal_tolerance > 0.)
        {
          const auto error = relative_goal_error(context, record);
          if (!error || !(*error <= parameters.goal_tolerance))
            return;
          add("the relative error of the goal is " + number(*error) + ", at most "
              + number(parameters.goal_tolerance));
        }
      const bool by_reference
        = context.reference_tets > 0
          && ((energy_wanted && !context.true_energy_error) || (ren_wanted && !context.true_ren));
      if (by_reference && trust == ReferenceTrust::unknown)
        text += "; the reference's own error is not known, so this holds only relative to it";
      else if (by_reference && trust == ReferenceTrust::doubtful)
        text += "; the reference is less than three times better, so the figure is rough";
      if (context.leaves_out && (energy_wanted || ren_wanted))
        text += "; what is near point forces and supports at points or lines is left out";
      decision.reason  = StopReason::tolerance;
      decision.success = true;
      decision.text    = text + ".";
    }



    /** Saturation, or a mesh as fine as the reference's. */
    void
    check_reference(const AdaptivityParameters &parameters,
                    const StoppingContext      &context,
                    const CycleRecord          &record,
                    const ReferenceTrust        trust,
                    StopDecision               &decision)
    {
      // An adaptive loop that another estimator drives does not use the reference.
      const bool drives
        = parameters.strategy == Strategy::adaptive
          && (parameters.refinement_indicator == AdaptivityParameters::RefinementIndicator::energy
              || parameters.refinement_indicator == AdaptivityParameters::RefinementIndicator::ren);
      // Who has turned the safeguard off gets the rules that were asked for and no others.
      const bool blind = trust == ReferenceTrust::saturated && !parameters.safeguard;
      const bool ends
        = (drives && !blind)
          || (parameters.strategy == Strategy::uniform && measured_with_reference(context));
      std::string text;
      if (trust == ReferenceTrust::saturated)
        {
          decision.reason = StopReason::saturation;
          text
            = "the reference is hardly better than the mesh: " + compared_errors(context, record);
        }
      else if (context.reference_tets > 0 && context.degree >= context.reference_degree
               && record.tets >= context.reference_tets)
        {
          decision.reason = StopReason::reference_mesh;
          text = "this mesh has " + std::to_string(record.tets) + " tetrahedra of degree "
                 + std::to_string(context.degree) + ", the reference "
                 + std::to_string(context.reference_tets) + " of degree "
                 + std::to_string(context.reference_degree);
        }
      else
        {
          if (trust == ReferenceTrust::doubtful && (drives || measured_with_reference(context)))
            decision.warnings.push_back("Figures measured with the reference are rough: "
                                        + compared_errors(context, record) + ".");
          return;
        }
      text
        += context.reference_is_hexahedra
             ? "; ask for a finer reference (Reference section: a smaller Tolerance, more Maximum "
               "unknowns or degree 3)."
             : "; ask for a finer reference (Reference section: a smaller volume bound or degree "
               "2).";
      if (ends)
        decision.text = "Stopped without convergence: " + text;
      else
        {
          decision.reason = StopReason::none;
          if (measured_with_reference(context))
            decision.warnings.push_back("The figures measure the reference's error: " + text);
        }
    }



    /** Limits on tetrahedra, unknowns and time. */
    void
    check_limits(const AdaptivityParameters &parameters,
                 const StoppingContext      &context,
                 const CycleRecord          &record,
                 StopDecision               &decision)
    {
      // A next mesh that would exceed the limit is not made: uniform refinement
      // multiplies by 8; an adaptive step of less than a fifth is not worth a solve.
      const double growth = parameters.strategy == Strategy::uniform     ? 8.
                            : parameters.strategy == Strategy::mesh_list ? 1.
                                                                         : 1.2;
      const auto   limit  = [&](const StopReason    reason,
                             const unsigned long value,
                             const unsigned long bound,
                             const std::string  &what) {
        if (decision.stop() || bound == 0 || growth * value <= bound)
          return;
        decision.reason = reason;
        decision.text
          = "Stopped at a limit: the mesh has " + std::to_string(value) + " " + what
            + (value > bound ? ", more than the " : ", and the next one would exceed the ")
            + std::to_string(bound) + " allowed.";
      };
      limit(StopReason::max_tets, record.tets, parameters.max_tets, "tetrahedra");
      limit(StopReason::max_dofs, record.dofs, parameters.max_dofs, "unknowns");
      if (!decision.stop() && parameters.max_seconds > 0.
          && context.elapsed_seconds >= parameters.max_seconds)
        {
          decision.reason = StopReason::max_seconds;
          decision.text   = "Stopped at a limit: the run took " + number(context.elapsed_seconds)
                          + " s, and " + number(parameters.max_seconds) + " s are allowed.";
        }
    }
  } // namespace



  ReferenceTrust
  reference_trust(const std::optional<double> &reference_error,
                  const std::optional<double> &mesh_error)
  {
    if (!reference_error || !mesh_error)
      return ReferenceTrust::unknown;
    if (*reference_error >= 0.7 * *mesh_error && *reference_error > 0.)
      return ReferenceTrust::saturated;
    return 3. * *reference_error > *mesh_error ? ReferenceTrust::doubtful : ReferenceTrust::trusted;
  }



  StopDecision
  decide_stop(const AdaptivityParameters     &parameters,
              const StoppingContext          &context,
              const std::vector<CycleRecord> &history)
  {
    StopDecision decision;
    if (history.empty())
      return decision;
    const CycleRecord   &record = history.back();
    const ReferenceTrust trust  = trust_of(context, record);

    const auto finish = [&decision](const StopReason reason, const std::string &text) {
      decision.reason  = reason;
      decision.success = true;
      decision.text    = text;
    };
    if (parameters.strategy == Strategy::adaptive || parameters.strategy == Strategy::uniform)
      check_tolerances(parameters, context, record, trust, decision);
    if (!decision.stop())
      check_reference(parameters, context, record, trust, decision);
    if (decision.stop())
      return decision;

    if (parameters.strategy == Strategy::none)
      finish(StopReason::one_mesh, "Done: the scene asks for one mesh.");
    else if (parameters.strategy == Strategy::mesh_list)
      {
        if (history.size() >= context.n_meshes)
          finish(StopReason::end_of_list,
                 "Done: all " + std::to_string(context.n_meshes) + " meshes of the list.");
        else
          check_limits(parameters, context, record, decision);
      }
    else if (history.size() >= parameters.max_cycles)
      {
        const bool tolerance_missed = any_tolerance(parameters);
        decision.reason             = StopReason::max_cycles;
        decision.success            = !tolerance_missed;
        decision.text               = (tolerance_missed ? "Stopped at a limit: " : "Done: ")
                        + std::to_string(history.size())
                        + (history.size() == 1 ? " cycle" : " cycles")
                        + (tolerance_missed ? ", and the tolerance is not reached." : ".");
      }
    else
      check_limits(parameters, context, record, decision);

    // A body meshed from scratch has as many cells by chance.
    if (!decision.stop() && history.size() > 1 && parameters.strategy == Strategy::adaptive
        && !parameters.coarsening)
      {
        const StopDecision no_new = decide_new_mesh(history[history.size() - 2].tets, record.tets);
        decision.reason           = no_new.reason;
        decision.text             = no_new.text;
      }
    return decision;
  }



  StopDecision
  decide_nothing_to_refine(const double largest_indicator)
  {
    StopDecision decision;
    if (largest_indicator == 0.)
      {
        decision.reason = StopReason::no_error;
        decision.text
          = "Stopped: every error indicator is zero up to rounding, so there is nothing to refine.";
      }
    else
      {
        decision.reason = StopReason::no_new_tets;
        decision.text   = "Stopped without convergence: the wanted sizes are nowhere below those "
                          "of the mesh (look at the minimum size, the minimum ratio and the limit "
                          "on tetrahedra).";
      }
    return decision;
  }



  StopDecision
  decide_new_mesh(const unsigned long old_tets, const unsigned long new_tets)
  {
    StopDecision decision;
    if (old_tets == new_tets)
      {
        decision.reason = StopReason::no_new_tets;
        decision.text   = "Stopped without convergence: TetGen returned the same "
                        + std::to_string(new_tets)
                        + " tetrahedra (look at TetGen/Steiner points and TetGen/Keep boundary).";
      }
    return decision;
  }



  StopDecision
  decide_uniform_fallback(const AdaptivityParameters &parameters, const CycleRecord &last)
  {
    StopDecision decision;
    if ((parameters.max_tets > 0 && 8 * last.tets > parameters.max_tets)
        || (parameters.max_dofs > 0 && 8 * last.dofs > parameters.max_dofs))
      {
        decision.reason = StopReason::no_better_mesh;
        decision.text
          = "Stopped without convergence: two meshes made from the mesh of cycle "
            + std::to_string(last.cycle) + " had worse energies, and cutting each of its "
            + std::to_string(last.tets)
            + " tetrahedra into eight would exceed the limits on tetrahedra or "
              "unknowns (look at the refinement indicator, the marking and the maximum ratio).";
      }
    return decision;
  }
} // namespace tetradapt::adapt
