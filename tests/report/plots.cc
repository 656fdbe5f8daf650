// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Plots: what is drawn of known records, names and numbers that could break a script, and
// gnuplot missing, failing and working.

#include "tetradapt/report/plots.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace tetradapt;
namespace fs = std::filesystem;

namespace
{
  std::string
  content(const fs::path &path)
  {
    std::ifstream      in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  unsigned int
  count(const std::string &text, const std::string &part)
  {
    unsigned int n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++n;
    return n;
  }

  void
  check(const std::string &what, const bool holds)
  {
    std::cout << what << ": " << (holds ? "yes" : "NO") << std::endl;
  }

  /** Errors that fall by half and a quarter while the unknowns grow by eight. */
  std::vector<adapt::CycleRecord>
  make_records()
  {
    std::vector<adapt::CycleRecord> records(4);
    for (unsigned int i = 0; i < records.size(); ++i)
      {
        adapt::CycleRecord &r   = records[i];
        r.cycle                 = i;
        r.tets                  = 40u << (3 * i);
        r.dofs                  = 100u << (3 * i);
        r.seconds_total         = 1.;
        r.relative_energy_error = std::pow(0.5, i);
        r.mean_ren              = std::pow(0.25, i);
        r.effectivity           = 1.;
        adapt::EstimateRecord same, spr;
        same.name       = "energy"; // the same curve as the error itself
        same.relative   = r.relative_energy_error;
        spr.name        = "spr";
        spr.relative    = 0.9 * *r.relative_energy_error;
        spr.effectivity = 0.9;
        r.estimates     = {same, spr};
        if (i > 0)
          r.mesh.dihedral_histogram = {{0, 0, 1, 2, 4, 2, 1, 0}};
      }
    records[2].acceptance = adapt::Acceptance::rejected;
    return records;
  }

  void
  scripts()
  {
    std::cout << report::gnuplot_text("it''s 5 % of\n{x}_1^\"2\" `id` \\") << '\n';
    report::LinePlot plot;
    plot.logarithmic_x = plot.logarithmic_y = true;
    plot.curves                             = {{"a", {{{1., 1.}}, {{2., 0.}}}, 0, 0, false},
                                               {"b", {{{-1., 1.}}, {{2., NAN}}, {{3., INFINITY}}}, 1, 0, false}};
    const std::string script                = report::gnuplot_script(plot);
    check("a curve without a point that can be shown is left out",
          count(script, "EOD") == 2 && count(script, "title \"a\"") == 1
            && count(script, "title \"b\"") == 0);
    check("one point has a range around it",
          count(script, "set xrange [0.90909091:1.1]") == 1
            && count(script, "set yrange [0.90909091:1.1]") == 1);
    plot.curves.erase(plot.curves.begin());
    check("nothing to show, no script", report::gnuplot_script(plot).empty());

    for (const auto &slope : report::theoretical_slopes({2, 1, 2}, true))
      std::cout << slope.exponent << " " << slope.label << "; ";
    std::cout << "\nclasses:";
    for (const auto &[number, n] : report::logarithmic_histogram({1., 1.5, 1.6, 9.9, 10., 0., NAN}))
      std::cout << ' ' << number << ':' << n;
    std::cout << "\ncycles:";
    for (const std::size_t n : {0, 1, 2, 3, 8})
      {
        for (const std::size_t i : report::chosen_cycles(n))
          std::cout << ' ' << i;
        std::cout << ';';
      }
    std::cout << std::endl;
  }

  void
  runs()
  {
    scene::Scene scene;
    scene.name                         = "beam";
    scene.exact_solution.strain_energy = 1.;
    const auto records                 = make_records();
    for (const auto &plot : report::plots_of_run(scene, records))
      std::cout << plot.name << ": " << count(plot.script, "<< EOD") << " data blocks, "
                << count(plot.script, " title \"") << " titles" << std::endl;
    const auto        all  = report::plots_of_run(scene, records);
    const std::string dofs = all[0].script, seconds = all[1].script;
    check("the rejected cycle is not shown",
          count(dofs, "\n6400 ") == 0 && count(dofs, "51200 0.125"));
    check("its time counts", count(seconds, "\n4 0.125\n") == 1 && count(seconds, "\n3 ") == 0);
    check("the slope of degree 1", count(dofs, "\"N^{−1/3}\"") == 1);
    const auto one = report::plots_of_run(scene, {records[0]});
    check("one cycle, no curves", one.size() == 1 && one[0].script.empty());

    const std::vector<report::PlottedRun> study{{"P1", 1, 0, 0, records}, {"P2", 2, 1, 1, records}};
    for (const auto &plot : report::plots_of_study("study", study))
      std::cout << plot.name << ": " << (plot.script.empty() ? "nothing" : "drawn") << std::endl;
  }

  /** Pictures with the gnuplot that @p path leads to. */
  void
  with_path(const std::string &what, const std::string &path)
  {
    setenv("PATH", path.c_str(), 1);
    const fs::path folder = "plots_scratch/pictures/plots";
    fs::remove_all(folder.parent_path());
    core::Log log;
    std::cout << what << ":\n";
    log.add_sink([](const core::LogLevel level, const std::string &text) {
      std::cout << "  " << (level == core::LogLevel::warning ? "warning: " : "") << text << '\n';
    });
    report::ResultFolder  results("plots_scratch/pictures");
    report::PictureFolder pictures(results, log);
    pictures.add("nothing", "");
    pictures.add("one", "plot x\n");
    pictures.add("two", "plot x\n");
    pictures.draw();
    std::cout << "  " << fs::exists(folder / "nothing.gp") << fs::exists(folder / "one.gp")
              << fs::exists(folder / "two.gp") << ' ' << content(folder / "one.svg")
              << content(folder / "two.svg") << std::endl;
  }

  void
  make_program(const std::string &folder, const std::string &text)
  {
    fs::create_directories(folder);
    std::ofstream(folder + "/gnuplot") << "#!/bin/sh\n" << text;
    fs::permissions(folder + "/gnuplot", fs::perms::owner_all);
  }
} // namespace

int
main()
{
  fs::remove_all("plots_scratch");
  scripts();
  runs();

  const std::string path = std::getenv("PATH");
  make_program("plots_scratch/good", "read line; echo \"<svg>$* $line</svg>\"\n");
  make_program("plots_scratch/bad", "echo; echo '  line 1: trouble' >&2; exit 1\n");
  make_program("plots_scratch/half", "echo '<svg>'\n");
  with_path("no gnuplot", "plots_scratch");
  with_path("one that works", "nowhere:plots_scratch/good");
  make_program("plots_scratch/joint",
               "n=1; while read line; do [ \"$line\" = reset ] && n=$((n+1)); done\n"
               "for i in 1 2; do [ $i -gt $n ] || echo \"<svg>$i of $n</svg>\"; done\n");
  with_path("one that draws both at once", "nowhere:plots_scratch/joint");
  with_path("one that fails", "plots_scratch/bad");
  with_path("half a picture", "plots_scratch/half");

  // The real one, where it is installed: names that could break a script or a picture.
  setenv("PATH", path.c_str(), 1);
  scene::Scene scene;
  scene.title = "it''s <5 %< `id` & \"{x}_1\" \\ done";
  core::Log    log;
  unsigned int n_warnings = 0;
  log.add_sink([&](const core::LogLevel level, const std::string &) {
    n_warnings += level == core::LogLevel::warning;
  });
  report::ResultFolder  results("plots_scratch/real");
  report::PictureFolder pictures(results, log);
  unsigned int          n_pictures = 0, n_plots = 0;
  for (const auto &plot : report::plots_of_run(scene, make_records()))
    {
      pictures.add(plot.name, plot.script);
      n_plots += !plot.script.empty();
    }
  pictures.draw();
  for (const auto &plot : report::plots_of_run(scene, make_records()))
    {
      const std::string svg = content("plots_scratch/real/plots/" + plot.name + ".svg");
      n_pictures += count(svg, "it''s &lt;5 %&lt; `id` &amp; \"{x}_1\" \\ done") == 1;
    }
  const bool installed = !report::find_gnuplot().empty();
  check("all pictures with gnuplot, none and one warning without",
        n_pictures == (installed ? n_plots : 0) && n_warnings == (installed ? 0 : 1));
  fs::remove_all("plots_scratch");
}
