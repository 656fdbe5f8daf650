// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/plots.h"

#include "tetradapt/report/record_columns.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace tetradapt::report
{
  namespace
  {
    using Record  = adapt::CycleRecord;
    using Records = std::vector<Record>;
    using Figure  = std::function<std::optional<double>(const Record &)>;
    using Points  = std::vector<std::array<double, 2>>;

    enum class Abscissa
    {
      cycle,
      dofs,
      tets,
      seconds ///< all cycles until then
    };

    Points
    points_of(const Records &records, const Abscissa abscissa, const Figure &figure)
    {
      Points points;
      double seconds = 0.;
      for (const Record &record : records)
        {
          seconds += record.seconds_total;
          if (record.acceptance == adapt::Acceptance::rejected)
            continue; // its time counts, its solution does not
          const double x = abscissa == Abscissa::cycle  ? record.cycle
                           : abscissa == Abscissa::dofs ? record.dofs
                           : abscissa == Abscissa::tets ? record.tets
                                                        : seconds;
          if (const auto y = figure(record))
            points.push_back({{x, *y}});
        }
      return points;
    }

    /** The plot's axes and slopes for an abscissa. */
    LinePlot
    make_plot(const std::string            &title,
              const std::string            &y_label,
              const Abscissa                abscissa,
              const std::vector<PlotSlope> &slopes = {})
    {
      LinePlot plot;
      plot.title         = title;
      plot.y_label       = y_label;
      plot.logarithmic_x = abscissa != Abscissa::cycle;
      plot.logarithmic_y = true;
      plot.slopes        = slopes;
      switch (abscissa)
        {
        case Abscissa::cycle:
          plot.x_label = "cycle";
          plot.whole_x = true;
          break;
        case Abscissa::dofs:
          plot.x_label = "unknowns N";
          if (!slopes.empty())
            plot.explanation = "triangles: best rates of theory";
          break;
        case Abscissa::tets:
          plot.x_label = "tetrahedra";
          break;
        case Abscissa::seconds:
          plot.x_label = "seconds, sum of all cycles so far";
          if (!slopes.empty())
            plot.explanation = "triangles: best rates if the time grows with N";
          break;
        }
      return plot;
    }

    const adapt::EstimateRecord *
    find_estimate(const Record &record, const std::string &name)
    {
      for (const auto &entry : record.estimates)
        if (entry.name == name)
          return &entry;
      return nullptr;
    }

    std::vector<std::string>
    estimator_names(const Records &records)
    {
      std::vector<std::string> names;
      for (const Record &record : records)
        for (const auto &entry : record.estimates)
          if (std::find(names.begin(), names.end(), entry.name) == names.end())
            names.push_back(entry.name);
      return names;
    }

    bool
    coincide(const Points &a, const Points &b)
    {
      return a.size() == b.size()
             && std::equal(a.begin(), a.end(), b.begin(), [](const auto &p, const auto &q) {
                  return p[0] == q[0] && std::abs(p[1] - q[1]) <= 1e-9 * std::abs(p[1]);
                });
    }

    /** Adds a curve with the next colour, if it shows something that none does yet. */
    void
    add_curve(LinePlot &plot, const std::string &label, const Points &points, unsigned int pattern)
    {
      if (points.empty()
          || std::any_of(plot.curves.begin(), plot.curves.end(), [&](const PlotCurve &other) {
               return coincide(other.points, points);
             }))
        return;
      const unsigned int number = plot.curves.size();
      plot.curves.push_back({label, points, number, pattern + number / n_plot_colours, false});
    }

    std::string
    error_label(const Records &records)
    {
      return adapt::is_true(records.back().error_source) ? "true energy error"
                                                         : "difference to the reference";
    }

    /** The error of a goal whose value is known, relative to it. */
    std::optional<double>
    relative_goal_error(const adapt::GoalRecord &goal)
    {
      if (!goal.exact || !goal.error || *goal.exact == 0.)
        return {};
      return std::abs(*goal.error / *goal.exact);
    }

    LinePlot
    convergence_of_run(const scene::Scene &scene, const Records &records, const Abscissa abscissa)
    {
      const auto has_l2 = std::any_of(records.begin(), records.end(), [](const Record &r) {
        return r.relative_l2_error.has_value();
      });
      LinePlot   plot   = make_plot(scene.title.empty() ? scene.name : scene.title,
                                "relative error",
                                abscissa,
                                theoretical_slopes({scene.degree}, has_l2));
      const auto add = [&](const std::string &label, unsigned int pattern, const Figure &figure) {
        add_curve(plot, label, points_of(records, abscissa, figure), pattern);
      };
      add(error_label(records), 0, [](const Record &r) { return r.relative_energy_error; });
      for (const std::string &name : estimator_names(records))
        add(name, 1, [&](const Record &r) -> std::optional<double> {
          const auto *entry = find_estimate(r, name);
          return entry == nullptr ? std::nullopt : entry->relative;
        });
      add("L2 error", 2, [](const Record &r) { return r.relative_l2_error; });
      for (const auto &goal : records.front().goals)
        add("goal " + goal.name, 3, [&](const Record &r) -> std::optional<double> {
          for (const auto &entry : r.goals)
            if (entry.name == goal.name)
              return relative_goal_error(entry);
          return {};
        });
      return plot;
    }

    LinePlot
    effectivity_of_run(const std::string &title, const Records &records)
    {
      LinePlot plot      = make_plot(title, "estimated over true error", Abscissa::cycle);
      plot.logarithmic_y = false;
      plot.level         = 1.;
      double largest     = 0.;
      for (const std::string &name : estimator_names(records))
        {
          const auto points
            = points_of(records, Abscissa::cycle, [&](const Record &r) -> std::optional<double> {
                const auto *entry = find_estimate(r, name);
                return entry == nullptr ? std::nullopt : entry->effectivity;
              });
          add_curve(plot, name, points, 0);
          for (const auto &point : points)
            largest = std::max(largest, point[1]);
        }
      if (plot.curves.empty())
        add_curve(plot,
                  "estimate",
                  points_of(records,
                            Abscissa::cycle,
                            [](const Record &r) { return r.effectivity; }),
                  0);
      plot.logarithmic_y = largest > 3.;
      return plot;
    }

    BarPlot
    quality_of_run(const std::string &title, const Records &records)
    {
      BarPlot plot;
      plot.title   = title;
      plot.x_label = "smallest dihedral angle of a cell, degrees";
      plot.y_label = "cells, per cent";
      for (const std::size_t i : chosen_cycles(records.size()))
        {
          const auto &counts = records[i].mesh.dihedral_histogram;
          double      all    = 0.;
          for (const unsigned long count : counts)
            all += count;
          if (all == 0.)
            continue;
          plot.series.push_back({cycle_label(records[i]), {}});
          for (const unsigned long count : counts)
            plot.series.back().values.push_back(100. * count / all);
        }
      const auto &begins = dihedral_class_begins;
      for (std::size_t i = 0; i < begins.size(); ++i)
        plot.classes.push_back(i + 1 == begins.size()
                                 ? "≥" + std::to_string(begins[i])
                                 : std::to_string(begins[i]) + "–" + std::to_string(begins[i + 1]));
      return plot;
    }

    LinePlot
    study_plot(const std::string             &title,
               const std::string             &y_label,
               const Abscissa                 abscissa,
               const std::vector<PlottedRun> &runs,
               const Figure                  &figure,
               const std::string             &key,
               const bool                     with_slopes = false)
    {
      std::vector<unsigned int> degrees;
      for (const PlottedRun &run : runs)
        degrees.push_back(run.degree);
      LinePlot plot
        = make_plot(title,
                    y_label,
                    abscissa,
                    with_slopes ? theoretical_slopes(degrees, false) : std::vector<PlotSlope>());
      plot.key = key;
      for (const PlottedRun &run : runs)
        plot.curves.push_back(
          {run.label, points_of(run.records, abscissa, figure), run.colour, run.pattern, false});
      return plot;
    }

    std::optional<double>
    first_goal_error(const Record &record)
    {
      for (const auto &goal : record.goals)
        if (goal.exact)
          return relative_goal_error(goal);
      return {};
    }
  } // namespace

  std::optional<double>
  main_effectivity(const adapt::CycleRecord &record)
  {
    if (!record.estimates.empty() && record.estimates.front().effectivity)
      return record.estimates.front().effectivity;
    return record.effectivity;
  }

  std::vector<PlotSlope>
  theoretical_slopes(const std::vector<unsigned int> &degrees, const bool with_l2)
  {
    // h^p and h^(p+1) with h ~ N^(-1/3).
    std::set<unsigned int> thirds;
    for (const unsigned int degree : degrees)
      {
        thirds.insert(degree);
        if (with_l2)
          thirds.insert(degree + 1);
      }
    std::vector<PlotSlope> slopes;
    for (const unsigned int n : thirds)
      slopes.push_back(
        {n / -3., "N^{−" + (n % 3 == 0 ? std::to_string(n / 3) : std::to_string(n) + "/3") + "}"});
    return slopes;
  }

  std::vector<NamedPlot>
  plots_of_run(const scene::Scene &scene, const std::vector<adapt::CycleRecord> &records)
  {
    std::vector<NamedPlot> plots;
    const std::string      title = scene.title.empty() ? scene.name : scene.title;
    if (records.size() > 1)
      {
        plots.push_back(
          {"convergence_dofs", gnuplot_script(convergence_of_run(scene, records, Abscissa::dofs))});
        plots.push_back({"convergence_seconds",
                         gnuplot_script(convergence_of_run(scene, records, Abscissa::seconds))});
        plots.push_back({"effectivity", gnuplot_script(effectivity_of_run(title, records))});
        LinePlot ren = make_plot(title, "REN", Abscissa::cycle);
        add_curve(ren,
                  "mean",
                  points_of(records, Abscissa::cycle, [](const Record &r) { return r.mean_ren; }),
                  0);
        add_curve(ren,
                  "largest",
                  points_of(records, Abscissa::cycle, [](const Record &r) { return r.max_ren; }),
                  0);
        plots.push_back({"ren", gnuplot_script(ren)});
      }
    if (!records.empty())
      plots.push_back({"quality", gnuplot_script(quality_of_run(title, records))});
    return plots;
  }

  std::vector<NamedPlot>
  plots_of_study(const std::string             &title,
                 const std::vector<PlottedRun> &runs,
                 const std::string             &key)
  {
    const bool all_measured = std::all_of(runs.begin(), runs.end(), [](const PlottedRun &run) {
      return std::all_of(run.records.begin(), run.records.end(), [](const Record &r) {
        return r.relative_energy_error || !r.relative_estimate;
      });
    });
    const std::string error_name
      = all_measured ? "relative energy error" : "relative energy error, measured or estimated";
    const Figure error = adapt::relative_error_or_estimate;
    const Figure ren   = [](const Record &r) { return r.mean_ren; };
    const auto   plot  = [&](const std::string &name,
                          const std::string &y_label,
                          const Abscissa     abscissa,
                          const Figure      &figure,
                          const bool         with_slopes) -> NamedPlot {
      return {name,
              gnuplot_script(study_plot(title, y_label, abscissa, runs, figure, key, with_slopes))};
    };
    LinePlot effectivity = study_plot(
      title, "estimated over true error", Abscissa::cycle, runs, main_effectivity, key);
    bool is_large = false;
    for (const PlotCurve &curve : effectivity.curves)
      for (const auto &point : curve.points)
        is_large = is_large || point[1] > 3.;
    effectivity.logarithmic_y = is_large;
    effectivity.level         = 1.;
    return {
      plot("convergence_dofs", error_name, Abscissa::dofs, error, true),
      plot("convergence_seconds", error_name, Abscissa::seconds, error, true),
      {"effectivity", gnuplot_script(effectivity)},
      plot("ren", "mean REN", Abscissa::cycle, ren, false),
      plot("ren_tets", "mean REN", Abscissa::tets, ren, false),
      plot("goal_dofs", "relative error of the goal", Abscissa::dofs, first_goal_error, false)};
  }
} // namespace tetradapt::report
