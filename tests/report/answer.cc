// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The tables of reactions and regions, and the last lines of a run: from known records.

#include "tetradapt/report/answer.h"
#include "tetradapt/report/reactions.h"
#include "tetradapt/report/results.h"
#include "tetradapt/report/text_lines.h"

#include <iostream>
#include <sstream>

using namespace tetradapt;
using adapt::StopReason;
using dealii::Point;
using dealii::Tensor;

namespace
{
  adapt::CycleRecord
  make_record()
  {
    adapt::CycleRecord r;
    r.cycle            = 2;
    r.tets             = 1200;
    r.dofs             = 5400;
    r.mesh.volume      = 1.99;
    r.mesh.body_volume = 2.;
    r.mesh.n_parts     = 1;
    solve::Equilibrium e;
    e.supports              = {{"wall", "support", {}, {}},
                               {"a support with a name that is much too long", "support", {}, {}}};
    e.loads                 = {{"tip", "traction", {}, {}}, {"weight, all", "gravity", {}, {}}};
    e.supports[0].resultant = {Tensor<1, 3>({-100., 1e-7, 20.}), Tensor<1, 3>({0., 0., -50.})};
    e.supports[0].extent    = {12, 1., 9, 0, 0.};
    e.supports[1].extent    = {0, 0., 1, 0, 0.};
    e.loads[0].resultant    = {Tensor<1, 3>({100., 0., 0.}), Tensor<1, 3>({0., 0., 50.})};
    e.loads[0].extent       = {1, 0.25, 0, 0, 0.};
    e.loads[1].resultant    = {Tensor<1, 3>({0., 0., -20.}), Tensor<1, 3>({-10., 20., 0.})};
    e.loads[1].extent       = {0, 0., 0, 1200, 1.99};
    e.imbalance             = {Tensor<1, 3>({1e-9, 0., 0.}), Tensor<1, 3>()};
    e.force_scale           = 300.;
    e.lever                 = 1.2;
    e.relative_imbalance    = 3e-12;
    e.allowed_imbalance     = 1e-8;
    r.equilibrium           = e;
    mechanics::RegionFigures bone{
      1, "bone", 1000, 1.5, 3., {0.01, Point<3>(1, 0, 0)}, {250., Point<3>(0, 0.5, 1e-17)}};
    mechanics::RegionFigures soft{
      7, "", 200, 0.49, 0., {0.02, Point<3>(2, 1, 0)}, {3., Point<3>(1, 1, 1)}};
    r.regions = {bone, soft};
    return r;
  }

  bool
  fits(const std::string &text)
  {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
      if (report::text_width(line) > 80)
        return false;
    return true;
  }

  void
  show(const std::string        &what,
       const scene::Scene       &scene,
       const adapt::CycleRecord &record,
       const StopReason          reason,
       const bool                success,
       const std::string        &text = "")
  {
    adapt::StopDecision decision;
    decision.reason          = reason;
    decision.success         = success;
    decision.text            = text;
    const std::string answer = report::answer_text(scene, record, decision);
    std::cout << "--- " << what << ": within 80 columns " << (fits(answer) ? "yes" : "NO") << '\n'
              << answer;
  }

  void
  errors()
  {
    scene::Scene       scene;
    adapt::CycleRecord record;
    record.tets = 10;
    show("nothing known", scene, record, StopReason::one_mesh, true);
    record.relative_energy_error = 0.0123;
    record.energy_error          = 1.;
    record.error_source          = adapt::ErrorSource::exact;
    adapt::EstimateRecord spr;
    spr.name                   = "spr";
    spr.which                  = scene::ErrorEstimator::spr;
    spr.relative               = 0.012;
    auto bound                 = spr;
    bound.name                 = "equilibrated";
    bound.which                = scene::ErrorEstimator::equilibrated;
    bound.relative             = 0.015;
    record.estimates           = {spr, bound};
    scene.adaptivity.strategy  = scene::AdaptivityParameters::Strategy::adaptive;
    scene.adaptivity.tolerance = 0.02;
    show("exact", scene, record, StopReason::tolerance, true);
    record.error_source             = adapt::ErrorSource::reference;
    record.reference_error_estimate = 0.004;
    scene.adaptivity.tolerance      = 0.001;
    show("reference",
         scene,
         record,
         StopReason::max_tets,
         false,
         "Stopped at a limit: the mesh has 10 tetrahedra, and the next one would exceed the 11 "
         "allowed.");
    record.error_source = adapt::ErrorSource::none;
    record.relative_energy_error.reset();
    adapt::GoalRecord goal;
    goal.name                  = "tip";
    goal.value                 = -0.25;
    goal.error_estimate        = 0.002;
    record.goals               = {goal, goal};
    record.goals[1].exact      = -0.3;
    record.goals[1].error      = -0.05;
    scene.adaptivity.strategy  = scene::AdaptivityParameters::Strategy::none;
    scene.adaptivity.tolerance = 0.;
    record.relative_estimate   = 0.012;
    show("estimates", scene, record, StopReason::one_mesh, true);
  }
} // namespace

int
main()
{
  const adapt::CycleRecord record = make_record();
  std::cout << report::csv_reactions({record}) << report::csv_regions({record})
            << report::text_reactions(*record.equilibrium) << report::text_regions(record.regions)
            << report::csv_results(report::results_of_solution(record));
  show("solution", {}, record, StopReason::one_mesh, true);
  adapt::CycleRecord loose              = record;
  loose.equilibrium->relative_imbalance = 0.01;
  for (unsigned int i = 0; i < 8; ++i)
    loose.equilibrium->loads.push_back(loose.equilibrium->loads[0]);
  show("not balanced", {}, loose, StopReason::one_mesh, true);
  errors();
  std::cout << report::wrapped("  word andanotherwordthatisfartoolongforaline x", 20, 4) << "["
            << report::padded("é", 3) << "] [" << report::padded("ééééé", 4) << "]\n";
}
