// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/plots.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::report
{
  std::vector<std::size_t>
  chosen_cycles(const std::size_t n)
  {
    if (n == 0)
      return {};
    std::vector<std::size_t> chosen{0, n / 2, n - 1};
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return chosen;
  }

  std::string
  cycle_label(const adapt::CycleRecord &record)
  {
    return "cycle " + std::to_string(record.cycle) + ", " + std::to_string(record.tets) + " tets";
  }

  std::map<int, unsigned long>
  logarithmic_histogram(const std::vector<double> &values)
  {
    std::map<int, unsigned long> counts;
    for (const double value : values)
      if (value > 0. && std::isfinite(value))
        ++counts[int(std::floor(5. * std::log10(value)))];
    return counts;
  }

  RunPlots::RunPlots(ResultFolder &folder, const core::Log &log) : folder(folder), log(log)
  {
  }

  void
  RunPlots::run_started(const scene::Scene &started)
  {
    scene = started;
    records.clear();
    indicators.clear();
  }

  void
  RunPlots::cycle_done(const adapt::CycleEvent &event)
  {
    records.push_back(event.record);
    indicators.push_back(event.indicators == nullptr ? std::map<int, unsigned long>()
                                                     : logarithmic_histogram(*event.indicators));
  }

  LinePlot
  RunPlots::indicator_plot() const
  {
    LinePlot plot;
    plot.title         = scene.title.empty() ? scene.name : scene.title;
    plot.x_label       = "indicator of a cell";
    plot.y_label       = "cells, per cent";
    plot.logarithmic_x = true;
    std::vector<std::size_t> driven;
    for (std::size_t i = 0; i < indicators.size(); ++i)
      if (!indicators[i].empty())
        driven.push_back(i);
    if (!driven.empty())
      for (const std::size_t k : chosen_cycles(driven.size()))
        {
          const std::size_t  i      = driven[k];
          const unsigned int number = plot.curves.size();
          plot.curves.push_back({cycle_label(records[i]), {}, number, 0, true});
          const auto &counts = indicators[i];
          double      all    = 0.;
          for (const auto &entry : counts)
            all += entry.second;
          // Empty classes between others, and one at each end, bring the outline to zero.
          for (int c = counts.begin()->first - 1; c <= counts.rbegin()->first + 1; ++c)
            {
              const auto found = counts.find(c);
              plot.curves.back().points.push_back(
                {{std::pow(10., (c + 0.5) / 5.),
                  found == counts.end() ? 0. : 100. * found->second / all}});
            }
        }
    return plot;
  }

  void
  RunPlots::run_done(const adapt::StopDecision &)
  {
    PictureFolder pictures(folder, log);
    for (const NamedPlot &plot : plots_of_run(scene, records))
      pictures.add(plot.name, plot.script);
    pictures.add("indicators", gnuplot_script(indicator_plot()));
    pictures.draw();
  }

  void
  draw_study(ResultFolder                  &folder,
             const std::string             &title,
             const std::vector<PlottedRun> &runs,
             const std::string             &key,
             const core::Log               &log)
  {
    constexpr std::size_t   most = 28;
    std::vector<PlottedRun> drawn(runs.begin(), runs.begin() + std::min(runs.size(), most));
    if (runs.size() > most)
      log.info("The plots show the first " + std::to_string(most) + " of "
               + std::to_string(runs.size()) + " runs.");
    PictureFolder pictures(folder, log);
    for (const NamedPlot &plot : plots_of_study(title, drawn, key))
      pictures.add(plot.name, plot.script);
    pictures.draw();
  }
} // namespace tetradapt::report
