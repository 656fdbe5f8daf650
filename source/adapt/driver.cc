// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/driver.h"

#include "tetradapt/adapt/cycle_errors.h"
#include "tetradapt/compare/transfer.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/on_first_rank.h"
#include "tetradapt/estimate/estimator.h"
#include "tetradapt/mesh/mesh_broadcast.h"
#include "tetradapt/mesh/mesh_factory.h"
#include "tetradapt/mesh/red_refinement.h"
#include "tetradapt/mesh/tetgen.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::adapt
{
  namespace
  {
    using scene::Plan;
    using Strategy = scene::AdaptivityParameters::Strategy;

    bool
    is_first_rank(MPI_Comm communicator)
    {
      int rank = 0;
      MPI_Comm_rank(communicator, &rank);
      return rank == 0;
    }

    double
    largest_norm(const std::vector<dealii::Tensor<1, 3>> &values)
    {
      // Not by squares, which vanish for very small displacements.
      double largest = 0.;
      for (const auto &value : values)
        largest = std::max(largest, std::hypot(value[0], value[1], value[2]));
      return largest;
    }
  } // namespace

  Driver::Driver(const scene::Scene            &scene,
                 const scene::Plan             &plan,
                 MPI_Comm                       communicator,
                 const core::Log               &log,
                 core::StageTimer              &timer,
                 const std::vector<Observer *> &observers,
                 MeshDescription                describe_mesh)
    : scene(scene), plan(plan), communicator(communicator), log(log), timer(timer),
      observers(observers), describe_mesh(std::move(describe_mesh)),
      drive(estimate::drive_of(scene))
  {
  }

  void
  Driver::run()
  {
    const bool first = is_first_rank(communicator);
    if (first)
      for (Observer *observer : observers)
        observer->run_started(scene);

    make_initial_mesh(0);
    make_reference();
    StopDecision decision;
    for (unsigned int number = 0; !decision.stop(); ++number)
      {
        Cycle cycle = solve_cycle(number);
        compare_and_estimate(cycle);
        history.push_back(cycle.record);
        core::on_first_rank(communicator, [&]() { announce(cycle); });
        decision = decide(cycle);
        for (const auto &warning : decision.warnings)
          log.warning("cycle " + std::to_string(number) + ": " + warning);
        if (!decision.stop())
          decision = next_mesh(cycle);
      }
    if (first)
      for (Observer *observer : observers)
        observer->run_done(decision.text);
    if (decision.success)
      log.info(decision.text);
    else
      log.warning(decision.text);
  }

  void
  Driver::make_initial_mesh(unsigned int number)
  {
    const auto scope = timer.scope("mesh");
    log.progress("making the mesh");
    mesh = mesh::make_on_first_rank(communicator,
                                    [&]() { return mesh::make_mesh(scene, number, log); });
    // The reference keeps the first mesh's map; a later mesh may have no region
    // that this one does not know.
    if (materials == nullptr)
      materials = std::make_unique<mechanics::MaterialMap>(scene, *mesh);
    start.reset();
    log.info((number == 0 ? "Initial mesh: " : "Mesh " + std::to_string(number) + ": ")
             + describe_mesh(*mesh));
  }

  void
  Driver::make_reference()
  {
    if (!plan.uses_reference())
      return;
    const auto scope = timer.scope("reference");
    reference        = std::make_unique<compare::Reference>(
      compare::make_reference(scene, *materials, mesh, communicator, log));
    sampling = std::make_shared<compare::ReferenceSampling>(reference->displacement,
                                                            *materials,
                                                            communicator);
    std::ostringstream text;
    text << "Reference: " << reference->description << "; estimated relative energy error "
         << reference->estimated_error / sampling->energy_norm();
    if (plan.needs(Plan::known_energy))
      {
        // What is known is sharper than what is estimated.
        const auto known
          = estimate::error_from_known_energy(scene.truth.energy, reference->energy, drive);
        if (known.error)
          {
            reference->estimated_error = *known.error;
            text << ", by the known energy " << *known.relative_error;
          }
      }
    log.info(text.str());
  }

  core::Log
  Driver::in_cycle(unsigned int number) const
  {
    return log.with_progress_prefix("cycle " + std::to_string(number) + ": ");
  }

  Driver::Cycle
  Driver::solve_cycle(unsigned int number)
  {
    Cycle cycle;
    cycle.record.cycle = number;
    {
      const auto scope = timer.scope("solve");
      cycle.solution   = solve::solve_static(
        scene, *materials, mesh, scene.degree, communicator, in_cycle(number), start.get());
    }
    cycle.record.points           = mesh->n_points();
    cycle.record.tets             = mesh->n_cells();
    cycle.record.dofs             = cycle.solution.n_dofs;
    cycle.record.strain_energy    = cycle.solution.strain_energy;
    cycle.record.max_displacement = largest_norm(cycle.solution.displacement->values);
    cycle.record.iterations       = cycle.solution.iterations;
    if (!std::isfinite(cycle.record.strain_energy) || !std::isfinite(cycle.record.max_displacement))
      throw core::NumericalError(
        "The solution is not finite. Look at the size of the loads and material constants: their "
        "product leaves the range of double precision.");
    cycle.comparison = std::make_unique<estimate::Comparison>(
      cycle.solution.displacement, *materials, scene.truth, sampling, communicator);
    return cycle;
  }

  void
  Driver::compare_and_estimate(Cycle &cycle)
  {
    {
      const auto scope = timer.scope("estimate");
      in_cycle(cycle.record.cycle).progress("comparing and estimating");
      const MeasuredErrors measured = measure_errors({scene, plan, drive, reference.get()},
                                                     cycle.solution.energy,
                                                     *cycle.comparison,
                                                     cycle.record);
      cycle.true_energy_error       = measured.true_energy_error;
      if (!measured.warning.empty())
        log.warning(measured.warning);
      if (plan.needs(Plan::marking) || plan.needs(Plan::sizing))
        cycle.indicators
          = estimate::make_estimator(estimate::estimator_name(scene.adaptivity.driver))
              ->estimate({*cycle.comparison})
              .indicators;
    }
    // Seconds since the last cycle ended, so that a row tells what the cycle cost.
    CycleRecord &record     = cycle.record;
    record.seconds_mesh     = timer.wall("mesh");
    record.seconds_solve    = timer.wall("solve");
    record.seconds_estimate = timer.wall("estimate") + timer.wall("marking");
    record.seconds_total    = timer.total_wall() - timer.wall("reference");
    for (const CycleRecord &before : history)
      {
        record.seconds_mesh -= before.seconds_mesh;
        record.seconds_solve -= before.seconds_solve;
        record.seconds_estimate -= before.seconds_estimate;
        record.seconds_total -= before.seconds_total;
      }
  }

  void
  Driver::announce(const Cycle &cycle)
  {
    const auto                 scope = timer.scope("output");
    const std::vector<double> *ren
      = plan.needs(Plan::nodal_ren) ? &cycle.comparison->ren().values : nullptr;
    const CycleEvent event{cycle.record,
                           *cycle.solution.displacement,
                           *materials,
                           cycle.indicators.empty() ? nullptr : &cycle.indicators,
                           ren};
    for (Observer *observer : observers)
      observer->cycle_done(event);
    std::ostringstream text;
    text << "Cycle " << cycle.record.cycle << ": " << cycle.solution.solver;
    if (cycle.record.iterations > 0)
      text << ", " << cycle.record.iterations << " iterations";
    log.info(text.str());
  }

  StopDecision
  Driver::decide(const Cycle &cycle) const
  {
    StoppingContext context;
    context.degree            = scene.degree;
    context.true_energy_error = cycle.true_energy_error;
    context.true_ren          = plan.needs(Plan::exact_comparison);
    context.n_meshes          = scene.mesh.n_meshes();
    context.elapsed_seconds   = timer.total_wall();
    if (reference != nullptr)
      {
        context.reference_tets   = reference->displacement->mesh().n_cells();
        context.reference_degree = reference->displacement->degree();
      }
    // Clocks differ from rank to rank; the decision must not.
    core::broadcast_bytes(&context.elapsed_seconds, sizeof(double), communicator);
    return decide_stop(scene.adaptivity, context, history);
  }

  StopDecision
  Driver::next_mesh(Cycle &cycle)
  {
    switch (scene.adaptivity.strategy)
      {
      case Strategy::none:
        return decide_new_mesh(mesh->n_cells(), mesh->n_cells());
      case Strategy::mesh_list:
        make_initial_mesh(cycle.record.cycle + 1);
        return {};
      case Strategy::uniform:
        {
          const auto scope = timer.scope("mesh");
          mesh             = std::make_shared<mesh::TetMesh>(
            mesh::red_refine(*mesh,
                             scene.degree == 2 ? &cycle.solution.displacement->edges() : nullptr));
          prepare_start(cycle);
          return {};
        }
      case Strategy::adaptive:
        return adapt_mesh(cycle);
      }
    return {};
  }

  double
  Driver::wanted_indicator_norm(const Cycle &cycle) const
  {
    const CycleRecord &record    = cycle.record;
    const double       tolerance = scene.adaptivity.tolerance;
    if (tolerance == 0. || scene.adaptivity.driver == scene::AdaptivityParameters::Driver::ren
        || !record.energy_error || record.relative_energy_error.value_or(0.) == 0.)
      return 0.;
    const double norm = *record.energy_error / *record.relative_energy_error;
    if (cycle.true_energy_error)
      return tolerance * norm;
    // The reference's own error is part of what the user is told.
    const double own = record.reference_error.value_or(0.);
    return own < tolerance ? std::sqrt(tolerance * tolerance - own * own) * norm : 0.;
  }

  SizeField
  Driver::make_size_field(const Cycle &cycle) const
  {
    SizeFieldOptions options
      = make_size_field_options(scene.adaptivity, scene.tetgen, scene.degree, mesh->n_cells());
    if (const auto marker = make_marker(scene.adaptivity))
      return marked_size_field(*mesh, marker->mark(cycle.indicators, *mesh), options);
    options.obtained_over_predicted = obtained_over_predicted;
    options.tolerance               = wanted_indicator_norm(cycle);
    return optimal_size_field(*mesh,
                              cycle.indicators,
                              options,
                              scene.degree == 2 ? &cycle.solution.displacement->edges() : nullptr);
  }

  void
  Driver::refine_mesh(const SizeField &field, unsigned int number)
  {
    const unsigned int old_tets = mesh->n_cells();
    in_cycle(number).progress("TetGen refines " + std::to_string(old_tets) + " tetrahedra");
    const mesh::Tetgen tetgen(scene.tetgen);
    const auto         old_mesh = mesh;
    mesh                        = mesh::make_on_first_rank(communicator, [&]() {
      mesh::TetgenReport report;
      mesh::TetMesh      refined = tetgen.refine(*old_mesh, field.sizing, &report);
      mesh::warn_of_unmet_wishes(report, log);
      return refined;
    });
    std::ostringstream text;
    text << "Refined from " << old_tets << " to " << mesh->n_cells() << " tetrahedra ("
         << std::lround(field.predicted_tets) << " predicted): " << describe_mesh(*mesh);
    log.info(text.str());
  }

  StopDecision
  Driver::adapt_mesh(Cycle &cycle)
  {
    SizeField field;
    {
      const auto scope = timer.scope("marking");
      in_cycle(cycle.record.cycle).progress("marking and sizing");
      field = make_size_field(cycle);
    }
    const double largest = *std::max_element(cycle.indicators.begin(), cycle.indicators.end());
    // Below this an error is rounding, and refining would chase noise.
    const bool is_exact = cycle.record.relative_energy_error.value_or(1.) < 1e-10;
    if (largest == 0. || is_exact || field.n_refined == 0)
      return decide_nothing_to_refine(is_exact ? 0. : largest);

    const auto         old_mesh = mesh;
    const unsigned int old_tets = mesh->n_cells();
    const bool         can_insist
      = scene.adaptivity.marking == scene::AdaptivityParameters::Marking::optimal_size;
    for (unsigned int attempt = 0; attempt < 4; ++attempt)
      {
        {
          const auto scope = timer.scope("mesh");
          refine_mesh(field, cycle.record.cycle + 1);
        }
        if (mesh->n_cells() != old_tets || !can_insist)
          break;
        // Sizes that are just not below what TetGen would split change nothing: the
        // factor, learnt from a few cells, was too large.
        mesh                    = old_mesh;
        obtained_over_predicted = 0.5 * field.obtained_over_predicted;
        const auto scope        = timer.scope("marking");
        field                   = make_size_field(cycle);
      }
    obtained_over_predicted = next_obtained_over_predicted(field, mesh->n_cells());
    prepare_start(cycle);
    return decide_new_mesh(old_tets, mesh->n_cells());
  }

  void
  Driver::prepare_start(Cycle &cycle)
  {
    // A small system is factorised, without a first iterate.
    const auto scope = timer.scope("estimate");
    if (mesh->n_points() > cycle.record.points && plan.needs(Plan::multigrid_solver))
      start = std::make_unique<mesh::NodalField>(
        compare::interpolate(*cycle.solution.displacement, cycle.comparison->locator(), mesh));
  }
} // namespace tetradapt::adapt
