// SPDX-License-Identifier: AGPL-3.0-or-later
// Every reason to stop, what is said about it, and what is never called success.

#include "tetradapt/adapt/stopping.h"

#include <iostream>

using namespace tetradapt;
using adapt::CycleRecord;
using adapt::StopDecision;
using adapt::StoppingContext;
using adapt::StopReason;
using scene::AdaptivityParameters;

struct Case
{
  AdaptivityParameters     parameters;
  StoppingContext          context;
  std::vector<CycleRecord> history;

  /** Adaptive, tolerance 0.05, a reference of degree 2 with 1 000 tets and an
   * error of 0.01; two cycles, the last with an estimate of 0.1. */
  Case()
  {
    parameters.strategy      = AdaptivityParameters::Strategy::adaptive;
    parameters.tolerance     = 0.05;
    parameters.max_cycles    = 10;
    context.degree           = 1;
    context.reference_tets   = 1000;
    context.reference_degree = 2;
    history.resize(2);
    history[0].tets                     = 50;
    history[1].cycle                    = 1;
    history[1].tets                     = 200;
    history[1].dofs                     = 300;
    history[1].relative_estimate        = 0.1;
    history[1].reference_error_estimate = 0.01;
  }

  void
  expect(const std::string &label, const StopReason reason, const bool success = false)
  {
    const StopDecision d = adapt::decide_stop(parameters, context, history);
    std::cout << (d.reason == reason && d.success == success ? "right: " : "WRONG: ") << label;
    if (!d.text.empty())
      std::cout << "\n  " << d.text;
    for (const auto &warning : d.warnings)
      std::cout << "\n  Warning: " << warning;
    std::cout << '\n';
  }
};

void
tolerances()
{
  Case c;
  c.expect("goes on", StopReason::none);
  CycleRecord &r = c.history[1];

  r.relative_estimate = 0.045;
  c.expect("reached", StopReason::tolerance, true);
  // sqrt(0.049^2 + 0.012^2) = 0.0504: the estimate alone would do.
  r.relative_estimate        = 0.049;
  r.reference_error_estimate = 0.012;
  c.expect("not with the reference's error", StopReason::none);
  r.relative_estimate = 0.03;
  c.expect("reached, roughly", StopReason::tolerance, true);
  r.relative_estimate = 0.015;
  c.expect("figures below the tolerance, but saturated", StopReason::saturation);
  r.reference_error_estimate = 0.06;
  c.expect("reference worse than the tolerance", StopReason::saturation);
  r.reference_error_estimate.reset();
  c.expect("reference of unknown error", StopReason::tolerance, true);

  c.context.true_energy_error = true;
  r.reference_error_estimate  = 0.01;
  r.relative_energy_error     = 0.06;
  c.expect("true error counts, not the estimate", StopReason::none);
  r.relative_energy_error = 0.04;
  c.expect("true error reached", StopReason::tolerance, true);

  c.parameters.ren_tolerance = 0.02;
  c.expect("one of two tolerances", StopReason::none);
  r.mean_ren = 0.015;
  c.expect("both tolerances", StopReason::tolerance, true);
  c.parameters.tolerance     = 0.;
  r.reference_error_estimate = 0.04;
  c.expect("REN measured with a reference as wrong as the mesh", StopReason::saturation);
  c.context.true_ren = true;
  c.expect("true REN", StopReason::tolerance, true);
}

void
references()
{
  {
    Case c;
    c.history[1].reference_error_estimate = 0.05;
    c.expect("doubtful reference", StopReason::none);
    c.history[1].reference_error_estimate = 0.07;
    c.expect("saturation", StopReason::saturation);
    c.context.true_energy_error        = true;
    c.history[1].relative_energy_error = 0.09;
    c.expect("saturation against the true error", StopReason::saturation);
    c.parameters.refinement_indicator = AdaptivityParameters::RefinementIndicator::exact;
    c.expect("saturated, but driven by the exact error", StopReason::none);
    c.parameters.strategy = AdaptivityParameters::Strategy::uniform;
    c.expect("saturated, uniform, true error known", StopReason::none);
    c.context.true_energy_error = false;
    c.expect("saturated, uniform", StopReason::saturation);
    c.parameters.strategy = AdaptivityParameters::Strategy::mesh_list;
    c.context.n_meshes    = 3;
    c.expect("saturated in a list of meshes", StopReason::none);
    c.history.push_back(c.history[1]);
    c.expect("end of the list", StopReason::end_of_list, true);
    c.parameters.strategy = AdaptivityParameters::Strategy::none;
    c.expect("one mesh", StopReason::one_mesh, true);
  }
  {
    Case c;
    c.context.reference_degree = 1;
    c.history[1].tets          = 1000;
    c.expect("as fine as the reference", StopReason::reference_mesh);
    c.context.reference_degree = 2;
    c.expect("as many cells, of lower degree", StopReason::none);
  }
}

void
limits()
{
  {
    Case c;
    c.parameters.max_cycles = 2;
    c.expect("cycles, tolerance missed", StopReason::max_cycles);
    c.parameters.tolerance = 0.;
    c.expect("cycles asked for", StopReason::max_cycles, true);
  }
  {
    Case c;
    c.parameters.max_tets = 240;
    c.expect("room for a fifth more", StopReason::none);
    c.parameters.max_tets = 239;
    c.expect("no room", StopReason::max_tets);
    c.parameters.max_tets = 199;
    c.expect("too many", StopReason::max_tets);
    c.parameters.strategy = AdaptivityParameters::Strategy::uniform;
    c.parameters.max_tets = 1600;
    c.expect("uniform, room", StopReason::none);
    c.parameters.max_tets = 1599;
    c.expect("uniform, no room", StopReason::max_tets);
    c.parameters.max_tets = 0;
    c.parameters.max_dofs = 2399;
    c.expect("unknowns", StopReason::max_dofs);
  }
  {
    Case c;
    c.parameters.max_seconds  = 10.;
    c.context.elapsed_seconds = 9.;
    c.expect("time left", StopReason::none);
    c.context.elapsed_seconds = 10.5;
    c.expect("no time left", StopReason::max_seconds);
  }
  {
    Case c;
    c.history[0].tets = 200;
    c.expect("no new tets", StopReason::no_new_tets);
  }
  std::cout << adapt::decide_new_mesh(200, 201).stop() << ' ' << adapt::decide_new_mesh(7, 7).text
            << '\n'
            << adapt::decide_nothing_to_refine(0.).text << '\n'
            << adapt::decide_nothing_to_refine(0.1).text << '\n'
            << "before the first cycle: "
            << adapt::decide_stop(AdaptivityParameters(), StoppingContext(), {}).stop() << '\n';
}

int
main()
{
  tolerances();
  references();
  limits();
}
