// SPDX-License-Identifier: AGPL-3.0-or-later
// convergence.csv, convergence.txt and the terminal's rows, from known records.

#include "tetradapt/report/convergence_table.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/report/record_columns.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace tetradapt;
namespace fs = std::filesystem;

/** A record in which every figure differs; the first cycle lacks what a scene
 * without a reference lacks. */
adapt::CycleRecord
make_record(const unsigned int cycle)
{
  adapt::CycleRecord r;
  r.cycle            = cycle;
  r.points           = 27 + 1000000UL * cycle;
  r.tets             = 48 + 12345678UL * cycle;
  r.dofs             = 3 * r.points;
  r.strain_energy    = M_PI * 1e-7;
  r.max_displacement = 1. / 3.;
  r.iterations       = 17 + cycle;
  r.seconds_mesh     = 0.125;
  r.seconds_solve    = 12345.678;
  r.seconds_estimate = 1e-5;
  r.seconds_total    = 0.;
  if (cycle > 0)
    {
      r.mean_ren                 = 0.01 * M_PI;
      r.max_ren                  = 2.294520123456789;
      r.relative_l2_error        = 1e-12 / 3.;
      r.relative_energy_error    = 0.0599999999999;
      r.energy_error             = 2. / 7.;
      r.estimate                 = 1e300 / 7.;
      r.effectivity              = -0.;
      r.error_source             = adapt::ErrorSource::reference;
      r.estimate_source          = "reference";
      r.reference_error_estimate = 123456789.123456789;
      // What drives comes first; the other one is not ready in the first cycle.
      adapt::EstimateRecord richardson;
      richardson.name     = "richardson";
      richardson.global   = 0.25;
      richardson.relative = 0.125;
      r.estimates         = {richardson};
    }
  adapt::EstimateRecord spr;
  spr.name        = "local degree";
  spr.global      = 0.5 + cycle;
  spr.relative    = 0.0625;
  spr.effectivity = 1.03125;
  spr.seconds     = 0.03125;
  r.estimates.insert(r.estimates.begin(), spr);
  adapt::GoalRecord goal;
  goal.name  = "tip";
  goal.value = 4. - cycle;
  goal.exact = 5.;
  goal.error = 1. + cycle;
  r.goals    = {goal};
  goal.name  = "a b"; // reads like the next one in a column's name
  r.goals.push_back(goal);
  goal.name  = "a_b";
  goal.value = 7.;
  r.goals.push_back(goal);
  r.mesh.min_dihedral   = 10.5;
  r.mesh.max_dihedral   = 160.25;
  r.mesh.oversized_tets = 3 + cycle;
  if (cycle > 0)
    r.mesh.requested_tets = 12345000.;
  r.iterations_to_tolerance = 30;
  r.acceptance = cycle == 1 ? adapt::Acceptance::rejected : adapt::Acceptance::accepted;
  return r;
}

/** Reads the table back by what CSV means, and compares with the records. */
void
check_csv(const std::string &text, const std::vector<adapt::CycleRecord> &records)
{
  std::istringstream in(text);
  std::string        line;
  std::getline(in, line);
  std::cout << line << std::endl;
  double       largest = 0.;
  unsigned int n_rows = 0, n_empty = 0;
  bool         presence_agrees = true, counts_agree = true;
  while (std::getline(in, line))
    {
      line += ',';
      std::istringstream row(line);
      for (const report::RecordColumn &column : report::record_columns(records))
        {
          std::string cell;
          std::getline(row, cell, ',');
          const auto value = column.value(records.at(n_rows));
          presence_agrees  = presence_agrees && column.has_value(records[n_rows]) == !cell.empty();
          n_empty += cell.empty();
          if (value && !cell.empty())
            {
              const double read = std::strtod(cell.c_str(), nullptr);
              if (*value != 0.)
                largest = std::max(largest, std::abs(read / *value - 1.));
              if (column.kind == report::RecordColumn::Kind::count)
                counts_agree = counts_agree && read == *value;
            }
        }
      presence_agrees = presence_agrees && row.peek() == EOF;
      ++n_rows;
    }
  std::cout << "rows " << n_rows << ", empty " << n_empty << ", presence agrees " << presence_agrees
            << ", counts agree " << counts_agree
            << ", figures within half a unit of the tenth digit " << (largest <= 5e-10)
            << ", not exact where they cannot be " << (largest > 0.) << std::endl;
}

std::string
content(const std::string &path)
{
  std::ifstream      in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

int
main()
{
  const std::string folder = "convergence_table_scratch";
  fs::remove_all(folder);
  fs::create_directory(folder);

  const std::vector<adapt::CycleRecord> records{make_record(0), make_record(1)};
  check_csv(report::csv_table(records), records);
  std::cout << report::csv_table(records) << std::endl;
  std::cout << "All columns have a value in some row:\n"
            << report::text_table(records) << "Some have none:\n"
            << report::text_table({make_record(0)}) << std::endl;
  adapt::CycleRecord plain;
  plain.cycle = 7;
  std::cout << "Nothing but a solution:\n" << report::csv_table({plain}) << std::endl;
  // A run of two cycles: the files are whole after each, nothing else is left.
  auto mesh    = std::make_shared<mesh::TetMesh>();
  mesh->points = {{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
  mesh->cells  = {{{0, 1, 2, 3}}};
  mesh->regions.assign(1, 0);
  scene::Scene scene;
  scene.materials.resize(1);
  const mechanics::MaterialMap materials(scene, *mesh);
  const mesh::NodalField       field(mesh, 1);

  core::Log    log;
  unsigned int n_cleared = 0;
  log.add_sink([&](const core::LogLevel level, const std::string &text) {
    n_cleared += level == core::LogLevel::progress && text.empty();
  });
  std::ostringstream       terminal;
  report::ResultFolder     results(folder);
  report::ConvergenceTable table(&results, &terminal, log);
  table.run_started(scene);
  for (unsigned int cycle = 0; cycle < 2; ++cycle)
    {
      table.cycle_done({records[cycle], field.mesh(), &field, materials, nullptr, nullptr});
      const std::vector<adapt::CycleRecord> so_far(records.begin(), records.begin() + cycle + 1);
      std::cout << "cycle " << cycle << ": csv "
                << (content(folder + "/convergence.csv") == report::csv_table(so_far)) << ", txt "
                << (content(folder + "/convergence.txt") == report::text_table(so_far))
                << ", files "
                << std::distance(fs::directory_iterator(folder), fs::directory_iterator())
                << ", progress cleared " << n_cleared << std::endl;
    }
  std::cout << terminal.str();

  // No files and no terminal asked for: none touched. A folder that is gone: said.
  report::ConvergenceTable silent(nullptr, nullptr, log);
  silent.cycle_done({records[0], field.mesh(), &field, materials, nullptr, nullptr});
  std::cout << "silent rows " << silent.records().size() << std::endl;
  fs::remove_all(folder);
  try
    {
      table.cycle_done({records[0], field.mesh(), &field, materials, nullptr, nullptr});
    }
  catch (const core::InputError &e)
    {
      std::cout << e.what() << std::endl;
    }
}
