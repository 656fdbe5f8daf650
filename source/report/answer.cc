// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/answer.h"

#include "tetradapt/adapt/load_record.h"
#include "tetradapt/report/reactions.h"
#include "tetradapt/report/text_lines.h"

#include "tetradapt/report/record_columns.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::report
{
  namespace
  {
    using adapt::ErrorSource;
    using adapt::StopReason;

    /** Of a line, and where its text begins behind the label. */
    constexpr unsigned int width = 80, text_column = 27;

    /** As many supports, loads, regions or goals are listed; the files have the rest. */
    constexpr std::size_t longest_list = 6;

    std::string
    percent(const double ratio)
    {
      return format_number(100. * ratio, 3) + " %";
    }

    /** "  label     text", the text wrapped behind the label. */
    std::string
    entry(const std::string &label, const std::string &text)
    {
      return wrapped("  " + padded(label, text_column - 3) + " " + text, width, text_column);
    }

    std::string
    rest_of(const std::size_t n, const std::string &what, const std::string &file)
    {
      return n <= longest_list
               ? ""
               : entry("",
                       "and " + std::to_string(n - longest_list) + " more " + what + ": " + file);
    }

    /** The region that has the largest @p figure, or null. */
    const mechanics::RegionFigures *
    largest(const adapt::CycleRecord &record,
            mechanics::LargestValue mechanics::RegionFigures::*figure)
    {
      const mechanics::RegionFigures *result = nullptr;
      for (const auto &region : record.regions)
        if (result == nullptr || (region.*figure).value > (result->*figure).value)
          result = &region;
      return result;
    }

    std::string
    extremes(const adapt::CycleRecord &record)
    {
      std::string text;
      const auto  add = [&](const std::string &label, const auto figure) {
        const mechanics::RegionFigures *region = largest(record, figure);
        if (region == nullptr)
          return;
        const mechanics::LargestValue &value = region->*figure;
        std::string                    line  = format_number(value.value, 5) + " at "
                           + short_vector(value.place, 1e-9 * value.place.norm());
        if (record.regions.size() > 1)
          line += ", region " + std::to_string(region->region)
                  + (region->name.empty() ? "" : " (" + region->name + ")");
        text += entry(label, line);
      };
      add("largest displacement", &mechanics::RegionFigures::displacement);
      add("largest von Mises stress", &mechanics::RegionFigures::von_mises);
      return text + rest_of(record.regions.size(), "regions", "regions.csv");
    }

    std::string
    acting(const std::string                     &label,
           const std::vector<solve::ActingForce> &list,
           const ForceNoise                      &noise)
    {
      std::string text;
      for (std::size_t i = 0; i < std::min(list.size(), longest_list); ++i)
        {
          const std::string force = "force " + short_vector(list[i].resultant.force, noise.force);
          const std::string moment
            = "moment " + short_vector(list[i].resultant.moment, noise.moment);
          const std::string name = label + " " + list[i].name;
          // A vector is not broken where it can be helped.
          text += force.size() + moment.size() + 2 <= width - text_column
                    ? entry(name, force + ", " + moment)
                    : entry(name, force + ",") + entry("", moment);
        }
      return text + rest_of(list.size(), label + "s", "reactions.csv");
    }

    /** How reference points move, and what holds them. */
    std::string
    motions(const solve::Equilibrium &forces, const ForceNoise &noise)
    {
      std::string text;
      for (std::size_t i = 0; i < std::min(forces.reference_points.size(), longest_list); ++i)
        {
          const solve::ReferencePoint &point = forces.reference_points[i];
          dealii::Tensor<1, 3>         t, R;
          for (unsigned int c = 0; c < 3; ++c)
            {
              t[c] = point.motion[c];
              R[c] = point.motion[3 + c];
            }
          const double turned = R.norm() * forces.lever;
          const double least  = 1e-9 * std::max(t.norm(), turned);
          text += entry("motion " + point.name,
                        "translation " + short_vector(t, least) + " of "
                          + short_vector(point.point, 1e-9 * forces.lever))
                  + entry("", "rotation " + short_vector(R, least / forces.lever) + " radians")
                  + entry("",
                          "reaction's moment about it "
                            + short_vector(point.reaction.moment, noise.moment));
        }
      return text + rest_of(forces.reference_points.size(), "reference points", "results.txt");
    }

    std::string
    balance(const adapt::CycleRecord &record)
    {
      if (!record.equilibrium)
        return "";
      const solve::Equilibrium &forces = *record.equilibrium;
      const ForceNoise          noise  = force_noise(forces);
      std::string               text
        = acting("reaction", forces.supports, noise) + acting("load", forces.loads, noise);
      text += motions(forces, noise);
      for (const adapt::LoadRecord &load : record.loads)
        {
          const std::string what = adapt::accuracy_of(load);
          if (!what.empty())
            text += entry("", "load " + load.name + " is " + what);
        }
      return text
             + entry("imbalance",
                     format_number(forces.relative_imbalance, 2) + " of all forces; allowed "
                       + format_number(forces.allowed_imbalance, 2)
                       + (forces.is_balanced() ? "" : ": EXCEEDED"));
    }

    std::string
    body(const adapt::CycleRecord &record)
    {
      const adapt::MeshRecord &mesh = record.mesh;
      double                   mass = 0., volume = 0.;
      for (const auto &region : record.regions)
        {
          mass += region.mass;
          volume += region.volume;
        }
      std::string text = "volume " + format_number(volume, 6);
      if (mesh.body_volume > 0.)
        {
          const double difference = volume / mesh.body_volume - 1.;
          text += std::abs(difference) < 1e-9
                    ? ", that of the input"
                    : ", " + percent(std::abs(difference)) + (difference < 0. ? " below" : " above")
                        + " the input's";
        }
      if (mass > 0.)
        text += "; mass " + format_number(mass, 6);
      if (mesh.n_parts > 0)
        text += "; " + std::to_string(mesh.n_parts)
                + (mesh.n_parts == 1 ? " part" : " separate parts");
      return entry("body", text);
    }

    std::string
    goals(const adapt::CycleRecord &record)
    {
      std::string text;
      for (std::size_t i = 0; i < std::min(record.goals.size(), longest_list); ++i)
        {
          const adapt::GoalRecord &goal = record.goals[i];
          std::string              line = format_number(goal.value, 6);
          if (goal.error)
            line += "; error " + format_number(*goal.error, 2) + ", measured with its exact value";
          else if (goal.error_estimate)
            line += "; error about " + format_number(*goal.error_estimate, 2)
                    + ", estimated by 'goal'";
          else
            line += "; its error is not known";
          text += entry("goal " + goal.name, line);
        }
      return text + rest_of(record.goals.size(), "goals", "results.txt");
    }

    std::string
    measured(const adapt::CycleRecord &record)
    {
      const std::string value = percent(*record.relative_energy_error);
      switch (record.error_source)
        {
        case ErrorSource::exact:
          return value + ", measured against the exact displacement";
        case ErrorSource::known_energy:
          return value + ", measured with the known strain energy";
        case ErrorSource::reference:
          return value + ", measured against the reference"
                 + (record.reference_error_estimate ? ", whose own error is estimated as "
                                                        + percent(*record.reference_error_estimate)
                                                    : ", whose own error is not known");
        case ErrorSource::none:
          break;
        }
      return value;
    }

    /** Behind "at most ...": how far a bound can be relied on. */
    std::string
    reserve_of_bound(const scene::Scene &scene, const adapt::CycleRecord &record)
    {
      if (!adapt::bound_is_guaranteed(scene, record))
        return "bound, up to the load's resolution, by '";
      return scene.mesh.projection == scene::MeshParameters::Projection::none
               ? "guaranteed bound by '"
               : "guaranteed bound for the body with flat faces by '";
    }

    std::string
    errors(const scene::Scene &scene, const adapt::CycleRecord &record)
    {
      std::string text;
      if (record.relative_energy_error && record.error_source != ErrorSource::none)
        text += entry("energy norm's error", measured(record));
      for (const adapt::EstimateRecord &estimate : record.estimates)
        {
          if (!estimate.is_energy_norm || !estimate.relative)
            continue;
          if (estimate.which == scene::ErrorEstimator::exact
              || estimate.which == scene::ErrorEstimator::energy)
            continue; // measured: above
          const bool bound = estimate.which == scene::ErrorEstimator::equilibrated;
          text += entry(text.empty() ? "energy norm's error" : "",
                        (bound ? "at most " : "about ") + percent(*estimate.relative)
                          + (bound ? ", " + reserve_of_bound(scene, record) : ", estimated by '")
                          + estimate.name + "'");
        }
      return text.empty() ? entry("error", "not known: nothing measures or estimates it") : text;
    }

    /** Where the energy does not converge, and what errors leave out for that. Supports that carry
     * nothing are no such places. */
    std::string
    singular_places(const adapt::CycleRecord &record)
    {
      std::string names, text;
      for (const adapt::LeftOutRecord &part : record.left_out)
        {
          bool acts = part.is_force;
          if (record.equilibrium && !part.is_force)
            for (const solve::ActingForce &support : record.equilibrium->supports)
              acts
                = acts
                  || ("Supports/" + support.name == part.name
                      && support.resultant.force.norm() > force_noise(*record.equilibrium).force);
          if (acts)
            names += (names.empty() ? "" : ", ") + part.name;
        }
      if (!names.empty())
        text = entry("energy",
                     "does not converge at " + names
                       + ": it grows without limit as the mesh is refined, and so do the largest "
                         "displacement and stress there");
      bool first = true;
      for (const adapt::LeftOutRecord &part : record.left_out)
        if (part.radius > 0.)
          {
            text += entry(first ? "errors leave out" : "",
                          "what is " + part.place + " (" + part.name + "), "
                            + (part.n_cells == 0
                                 ? "where tetrahedra are larger: none yet"
                                 : std::to_string(part.n_cells)
                                     + (part.n_cells == 1 ? " tetrahedron" : " tetrahedra")));
            first = false;
          }
      return text;
    }

    std::string
    tolerances(const scene::Scene &scene, const adapt::StopDecision &decision)
    {
      const scene::AdaptivityParameters &parameters = scene.adaptivity;
      std::string                        text;
      const auto add = [&](const double tolerance, const std::string &what) {
        if (tolerance > 0.)
          text += (text.empty() ? "" : ", ") + percent(tolerance) + " of the " + what;
      };
      add(parameters.tolerance, "energy norm");
      add(parameters.ren_tolerance, "mean REN");
      add(parameters.goal_tolerance, "goal");
      if (text.empty())
        return "";
      return entry("tolerance",
                   text
                     + (decision.reason == StopReason::tolerance ? ": reached" : ": NOT reached"));
    }

    std::string
    error_advice(const scene::Scene &scene, const adapt::CycleRecord &record)
    {
      const bool is_known = record.relative_energy_error || record.relative_estimate;
      if (scene.formulation == scene::Formulation::finite_strain)
        return scene.adaptivity.strategy == scene::AdaptivityParameters::Strategy::none
                 ? "learn how wrong this is: set Adaptivity/Strategy = uniform with Maximum cycles "
                   "= 3, "
                   "and see how much the values still change."
                 : "look at how much the values still change from cycle to cycle: errors are not "
                   "estimated with Formulation = finite strain.";
      if (!is_known && !record.left_out.empty())
        return "learn how wrong this is away from points and lines: add Estimation/Estimators = "
               "residual (cheap) or spr, or set Adaptivity/Strategy = adaptive.";
      if (!is_known)
        return "learn how wrong this is: add Estimation/Estimators = residual (cheap), spr, or "
               "equilibrated (a bound), or set Adaptivity/Strategy = adaptive.";
      if (scene.adaptivity.strategy == scene::AdaptivityParameters::Strategy::adaptive)
        return "if this is not accurate enough, set Adaptivity/Tolerance and raise "
               "Adaptivity/Maximum cycles.";
      return "if this is not accurate enough, set Adaptivity/Strategy = adaptive and "
             "Adaptivity/Tolerance.";
    }
  } // namespace

  std::string
  advice(const scene::Scene        &scene,
         const adapt::CycleRecord  &record,
         const adapt::StopDecision &decision)
  {
    if (record.equilibrium && !record.equilibrium->is_balanced())
      return "make Solver/Tolerance smaller, or set Solver/Type = direct: the solver has left too "
             "much of the loads.";
    const std::string degree
      = scene.degree == 1 ? ", or use quadratic elements (Degree = 2)" : std::string();
    switch (decision.reason)
      {
      case StopReason::tolerance:
        return "nothing; the tolerance is reached.";
      case StopReason::no_error:
        return "nothing; no indicator sees an error.";
      case StopReason::max_cycles:
        if (decision.success)
          return error_advice(scene, record);
        return "raise Adaptivity/Maximum cycles" + degree + ".";
      case StopReason::max_tets:
        return "raise Adaptivity/Maximum tetrahedra" + degree + ".";
      case StopReason::max_dofs:
        return "raise Adaptivity/Maximum unknowns.";
      case StopReason::max_seconds:
        return "allow more time: Adaptivity/Maximum seconds.";
      case StopReason::saturation:
      case StopReason::reference_mesh:
        return "make the reference finer (section Reference).";
      case StopReason::no_new_tets:
      case StopReason::no_better_mesh:
        return "change what the reason above names.";
      case StopReason::one_mesh:
      case StopReason::end_of_list:
      case StopReason::none:
        break;
      }
    return error_advice(scene, record);
  }

  std::string
  answer_text(const scene::Scene        &scene,
              const adapt::CycleRecord  &record,
              const adapt::StopDecision &decision)
  {
    std::string text
      = wrapped("Answer (cycle " + std::to_string(record.cycle) + ", " + std::to_string(record.tets)
                  + " tetrahedra, " + std::to_string(record.dofs) + " unknowns):",
                width,
                2);
    text += extremes(record) + balance(record) + body(record) + goals(record)
            + errors(scene, record) + singular_places(record) + tolerances(scene, decision);
    if (!decision.success)
      text += entry("end", decision.text);
    return text + entry("next", advice(scene, record, decision));
  }

  void
  Answer::run_started(const scene::Scene &started)
  {
    scene = started;
    last.reset();
    answer.clear();
  }

  void
  Answer::cycle_done(const adapt::CycleEvent &event)
  {
    if (event.record.acceptance == adapt::Acceptance::accepted)
      last = event.record;
  }

  void
  Answer::run_done(const adapt::StopDecision &decision)
  {
    if (last)
      answer = answer_text(scene, *last, decision);
  }
} // namespace tetradapt::report
