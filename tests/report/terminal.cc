// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the terminal shows: at most 80 columns, details on request only, and the heading of
// the table again after every 20 rows.

#include "tetradapt/report/convergence_table.h"
#include "tetradapt/report/log_sinks.h"

#include <algorithm>
#include <iostream>
#include <sstream>

using namespace tetradapt;

namespace
{
  /** Characters, not bytes, of the longest line. */
  std::size_t
  longest_line(const std::string &text)
  {
    std::istringstream in(text);
    std::size_t        longest = 0;
    for (std::string line; std::getline(in, line);)
      longest = std::max<std::size_t>(longest, std::count_if(line.begin(), line.end(), [](char c) {
                                        return (c & 0xC0) != 0x80;
                                      }));
    return longest;
  }

  void
  check(const std::string &what, const bool holds)
  {
    std::cout << what << ": " << (holds ? "yes" : "NO") << std::endl;
  }

  std::string
  shown(const bool verbose, const bool brief, const bool is_terminal, const unsigned int width)
  {
    report::TerminalSink::Options options;
    options.verbose     = verbose;
    options.brief       = brief;
    options.is_terminal = is_terminal;
    options.width       = width;
    core::Log                  log;
    std::ostringstream         stream;
    const report::TerminalSink sink(log, stream, options);
    log.detail("a detail");
    log.info("Mesh: 123456 points, 1234567 tetrahedra, dihedral angles 26.57 to 109.5 degrees and "
             "ünïcödé words up to the end of it");
    log.info("first\n  indented and not broken\nlast");
    log.warning("a warning that is longer than a line of eighty characters has room for, and so "
                "goes on");
    return stream.str();
  }

  void
  messages()
  {
    std::cout << shown(false, false, false, 80) << "verbose, 40 columns, a terminal:\n"
              << shown(true, false, true, 40) << "brief:\n"
              << shown(false, true, false, 80);
    check("no line is longer than 80", longest_line(shown(true, false, true, 200)) <= 80);
    check("no line is longer than 40", longest_line(shown(true, false, true, 40)) <= 40);
  }

  /** A record with everything that the table can show. */
  adapt::CycleRecord
  full_record(const unsigned int cycle)
  {
    adapt::CycleRecord r;
    r.cycle                    = cycle;
    r.points                   = 12345678;
    r.tets                     = 98765432;
    r.dofs                     = 123456789;
    r.mean_ren                 = 1.2345678e-12;
    r.max_ren                  = 1.;
    r.relative_l2_error        = 1.2345678e-12;
    r.relative_energy_error    = 1.2345678e-12;
    r.error_source             = adapt::ErrorSource::known_energy;
    r.estimate                 = 0.5;
    r.relative_estimate        = 1.2345678e-12;
    r.estimate_source          = "reference";
    r.reference_error_estimate = 1.2345678e-12;
    adapt::EstimateRecord estimate;
    estimate.name        = "averaging";
    estimate.relative    = 1.2345678e-12;
    estimate.effectivity = 12.345678;
    r.estimates          = {estimate};
    adapt::GoalRecord goal;
    goal.name       = "fourteen chars";
    goal.value      = -1.23456789e-12;
    r.goals         = {goal};
    r.seconds_solve = 12345.67;
    r.seconds_total = 12345.67;
    return r;
  }

  void
  table()
  {
    const auto columns = report::terminal_columns({full_record(0)});
    std::cout << report::terminal_heading(columns) << '\n'
              << report::terminal_row(columns, full_record(0)) << '\n';
    auto few = full_record(1);
    few.goals.clear();
    few.estimates[0].which = scene::ErrorEstimator::energy;
    few.error_source       = adapt::ErrorSource::reference;
    std::cout << report::terminal_heading(report::terminal_columns({few})) << '\n';

    auto mesh    = std::make_shared<mesh::TetMesh>();
    mesh->points = {{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
    mesh->cells  = {{{0, 1, 2, 3}}};
    mesh->regions.assign(1, 0);
    scene::Scene scene;
    scene.materials.resize(1);
    const mechanics::MaterialMap materials(scene, *mesh);
    const mesh::NodalField       field(mesh, 1);
    core::Log                    log;
    std::ostringstream           terminal;
    report::ConvergenceTable     table(nullptr, &terminal, log);
    table.run_started(scene);
    for (unsigned int cycle = 0; cycle < 45; ++cycle)
      table.cycle_done({full_record(cycle), field.mesh(), &field, materials, nullptr, nullptr});
    std::istringstream in(terminal.str());
    unsigned int       row = 0;
    for (std::string line; std::getline(in, line); ++row)
      if (line.find("cycle") == 0)
        std::cout << "heading in line " << row << '\n';
    check("no row is longer than 80", longest_line(terminal.str()) <= 80);
  }
} // namespace

int
main()
{
  messages();
  table();
}
