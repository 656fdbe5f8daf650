// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/results.h"

#include "tetradapt/report/reactions.h"
#include "tetradapt/report/record_columns.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::report
{
  namespace
  {
    using Kind = RecordColumn::Kind;

    std::vector<std::optional<double>>
    figures(const Result &result)
    {
      return {result.exact,
              result.computed,
              result.error,
              result.relative_error(),
              result.error_estimate};
    }

    const std::vector<std::string> heading{
      "result", "exact", "computed", "error", "relative_error", "error_estimate", "error_source"};
  } // namespace

  std::optional<double>
  Result::relative_error() const
  {
    if (!error || !exact || *exact == 0.)
      return {};
    return std::abs(*error / *exact);
  }

  std::vector<Result>
  results_of(const scene::Scene &scene, const adapt::CycleRecord &record)
  {
    std::vector<Result> results;
    if (scene.exact_solution.has_energy())
      {
        const double exact = scene.exact_solution.strain_energy;
        results.push_back({"strain energy",
                           exact,
                           record.strain_energy,
                           exact - record.strain_energy,
                           {},
                           "known energy"});
      }
    const auto add_norm =
      [&](const std::string &name, const std::optional<double> &error, const std::string &source) {
        if (error)
          results.push_back({name, 0., *error, 0. - *error, {}, source});
      };
    if (adapt::is_true(record.error_source))
      add_norm("relative energy error",
               record.relative_energy_error,
               record.error_source == adapt::ErrorSource::exact ? "exact" : "known energy");
    if (scene.exact_solution.has_displacement())
      {
        add_norm("relative L2 error", record.relative_l2_error, "exact");
        add_norm("relative H1 error", record.relative_h1_error, "exact");
      }
    for (const adapt::GoalRecord &goal : record.goals)
      results.push_back({"goal " + goal.name,
                         goal.exact,
                         goal.value,
                         goal.error,
                         goal.error_estimate,
                         goal.error            ? "exact"
                         : goal.error_estimate ? "estimate goal"
                                               : ""});
    return results;
  }

  std::vector<Result>
  results_of_solution(const adapt::CycleRecord &record)
  {
    std::vector<Result> results;
    const auto          add = [&](const std::string &name, const double value) {
      results.push_back({name, {}, value, {}, {}, ""});
    };
    const adapt::MeshRecord &mesh = record.mesh;
    if (mesh.volume > 0. && mesh.body_volume > 0.)
      results.push_back(
        {"volume", mesh.body_volume, mesh.volume, mesh.body_volume - mesh.volume, {}, "body"});
    else if (mesh.volume > 0.)
      add("volume", mesh.volume);
    if (mesh.n_parts > 0)
      add("parts", mesh.n_parts);
    double mass = 0.;
    for (const mechanics::RegionFigures &region : record.regions)
      {
        const std::string name = "region " + std::to_string(region.region);
        mass += region.mass;
        add(name + " max displacement", region.displacement.value);
        add(name + " max von Mises stress", region.von_mises.value);
      }
    if (mass > 0.)
      add("mass", mass);
    if (!record.equilibrium)
      return results;
    const auto add_vector = [&](const std::string &name, const dealii::Tensor<1, 3> &vector) {
      for (unsigned int c = 0; c < 3; ++c)
        add(name + " " + "xyz"[c], vector[c]);
    };
    const auto add_all = [&](const std::string &kind, const std::vector<solve::ActingForce> &list) {
      for (const solve::ActingForce &acting : list)
        {
          add_vector(kind + " " + acting.name + " force", acting.resultant.force);
          add_vector(kind + " " + acting.name + " moment", acting.resultant.moment);
        }
    };
    add_all("support", record.equilibrium->supports);
    add_all("load", record.equilibrium->loads);
    for (const solve::ReferencePoint &point : record.equilibrium->reference_points)
      {
        dealii::Tensor<1, 3> t, R;
        for (unsigned int c = 0; c < 3; ++c)
          {
            t[c] = point.motion[c];
            R[c] = point.motion[3 + c];
          }
        const std::string name = "support " + point.name;
        add_vector(name + " reference point", point.point);
        add_vector(name + " translation", t);
        add_vector(name + " rotation", R);
        add_vector(name + " moment about it", point.reaction.moment);
      }
    add("relative imbalance", record.equilibrium->relative_imbalance);
    add("allowed imbalance", record.equilibrium->allowed_imbalance);
    return results;
  }

  std::string
  csv_results(const std::vector<Result> &results)
  {
    std::string text;
    for (const std::string &name : heading)
      text += (text.empty() ? "" : ",") + name;
    text += '\n';
    for (const Result &result : results)
      {
        text += csv_text(result.name);
        for (const auto &figure : figures(result))
          text += "," + format_cell(Kind::figure, figure, 10, -1, "");
        text += "," + csv_text(result.error_source) + '\n';
      }
    return text;
  }

  std::string
  text_results(const std::vector<Result> &results)
  {
    // Short, for the screen has 80 columns; what no result has is left out.
    std::vector<std::vector<std::string>> rows{
      {"result", "exact", "computed", "error", "rel. error", "estimate", "source"}};
    for (const Result &result : results)
      {
        rows.push_back({result.name});
        for (const auto &figure : figures(result))
          rows.back().push_back(format_cell(Kind::figure, figure, 6, -1, "-"));
        rows.back().push_back(result.error_source.empty() ? "-" : result.error_source);
      }
    for (std::size_t column = rows[0].size(); column-- > 0;)
      if (std::all_of(rows.begin() + 1, rows.end(), [&](const auto &row) {
            return row[column] == "-";
          }))
        for (auto &row : rows)
          row.erase(row.begin() + column);
    return aligned_table(rows, 1);
  }

  ResultsSummary::ResultsSummary(ResultFolder *folder, const core::Log &log)
    : folder(folder), log(log)
  {
  }

  void
  ResultsSummary::run_started(const scene::Scene &started)
  {
    scene = started;
    last.reset();
  }

  void
  ResultsSummary::cycle_done(const adapt::CycleEvent &event)
  {
    if (event.record.acceptance == adapt::Acceptance::accepted)
      last = event.record;
  }

  void
  ResultsSummary::run_done(const adapt::StopDecision &)
  {
    if (!last)
      return;
    auto        results = results_of(scene, *last);
    std::string table   = results.empty() ? "" : text_results(results);
    if (!results.empty())
      log.info("Results of cycle " + std::to_string(last->cycle) + ":\n"
               + table.substr(0, table.size() - 1));
    const auto more = results_of_solution(*last);
    results.insert(results.end(), more.begin(), more.end());
    if (results.empty() || folder == nullptr)
      return;
    const auto append = [&](const std::string &text) {
      table += (table.empty() || text.empty() ? "" : "\n") + text;
    };
    append(text_regions(last->regions));
    if (last->equilibrium)
      append(text_reactions(*last->equilibrium));
    folder->write("results.csv", csv_results(results));
    folder->write("results.txt", table);
  }
} // namespace tetradapt::report
