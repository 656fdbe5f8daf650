// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a run says in the end of what is known, and of its meshes: from known records.

#include "tetradapt/report/results.h"
#include "tetradapt/adapt/stopping.h"
#include "tetradapt/report/mesh_report.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace tetradapt;
namespace fs = std::filesystem;

namespace
{
  std::string
  content(const std::string &path)
  {
    std::ifstream      in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  adapt::CycleRecord
  make_record()
  {
    adapt::CycleRecord r;
    r.cycle                 = 2;
    r.points                = 30;
    r.tets                  = 100;
    r.strain_energy         = 1.98;
    r.relative_energy_error = 0.1;
    r.error_source          = adapt::ErrorSource::known_energy;
    adapt::GoalRecord tip;
    tip.name           = "tip";
    tip.value          = -1.5;
    tip.exact          = -2.;
    tip.error          = -0.5;
    tip.error_estimate = -0.4;
    adapt::GoalRecord unknown;
    unknown.name              = "stress";
    unknown.value             = 1e-300;
    r.goals                   = {tip, unknown};
    r.mesh.requested_tets     = 123.75;
    r.mesh.oversized_tets     = 4;
    r.mesh.volume_drift       = -1e-16;
    r.mesh.min_dihedral       = 12.5;
    r.mesh.max_dihedral       = 150.;
    r.mesh.max_aspect_ratio   = 9.25;
    r.mesh.dihedral_histogram = {{0, 0, 5, 20, 40, 25, 8, 2}};
    r.mesh.counts_by_id       = "boundary 1: 20, 2: 22; region 0: 100, \"quoted\"";
    return r;
  }
} // namespace

int
main()
{
  scene::Scene scene;
  scene.exact_solution.strain_energy = 2.;
  adapt::CycleRecord record          = make_record();
  const auto         results         = report::results_of(scene, record);
  std::cout << report::csv_results(results) << report::text_results(results) << '\n';
  std::cout << report::describe_mesh_record(record) << '\n' << report::csv_meshes({record}) << '\n';
  record.mesh.volume_drift       = -0.015;
  record.mesh.largest_projection = 0.25;
  record.mesh.unprojected_points = 3;
  record.mesh.requested_tets.reset();
  std::cout << report::describe_mesh_record(record) << '\n'
            << "nothing reported: '" << report::describe_mesh_record({}) << "'\n";

  // The last cycle that was accepted is told, and nothing where nothing is known.
  fs::remove_all("results_scratch");
  report::ResultFolder folder("results_scratch");
  auto                 mesh = std::make_shared<mesh::TetMesh>();
  mesh->points              = {{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
  mesh->cells               = {{{0, 1, 2, 3}}};
  mesh->regions.assign(1, 0);
  scene.materials.resize(1);
  const mechanics::MaterialMap materials(scene, *mesh);
  const mesh::NodalField       field(mesh, 1);
  core::Log                    log;
  log.add_sink(
    [](const core::LogLevel, const std::string &text) { std::cout << "log: " << text << '\n'; });
  report::ResultsSummary summary(&folder, log);
  summary.run_started(scene);
  summary.cycle_done({make_record(), field.mesh(), &field, materials, nullptr, nullptr});
  adapt::CycleRecord worse = make_record();
  worse.cycle              = 3;
  worse.acceptance         = adapt::Acceptance::rejected;
  summary.cycle_done({worse, field.mesh(), &field, materials, nullptr, nullptr});
  summary.run_done({});
  std::cout << "files agree: "
            << (content("results_scratch/results.csv") == report::csv_results(results))
            << (content("results_scratch/results.txt") == report::text_results(results)) << '\n';
  fs::remove("results_scratch/results.csv");
  fs::remove("results_scratch/results.txt");
  scene.exact_solution.strain_energy = 0.;
  worse.goals.clear();
  worse.acceptance   = adapt::Acceptance::accepted;
  worse.error_source = adapt::ErrorSource::none;
  summary.run_started(scene);
  summary.cycle_done({worse, field.mesh(), &field, materials, nullptr, nullptr});
  summary.run_done({});
  std::cout << "nothing known, no files: " << !fs::exists("results_scratch/results.csv")
            << !fs::exists("results_scratch/results.txt") << '\n';
  fs::remove_all("results_scratch");
}
