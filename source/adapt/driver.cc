// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/driver.h"

#include "tetradapt/adapt/cycle_estimates.h"
#include "tetradapt/adapt/left_out.h"
#include "tetradapt/adapt/load_record.h"
#include "tetradapt/adapt/placement.h"
#include "tetradapt/adapt/reference_maker.h"
#include "tetradapt/adapt/solution_record.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/on_first_rank.h"
#include "tetradapt/mesh/finalize.h"

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

    /** Degrees. On cells of 0.1 degree displacements and estimates still have seven
     * digits. */
    constexpr double flat_angle = 0.01;

    /** Energies, of which roots and squares are taken, that are within the range of
     * double precision with room for both. */
    constexpr double smallest_energy = 1e-200, largest_energy = 1e200;
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
      drive(estimate::drive_of(scene)),
      keeps_system(any_estimator(scene, plan, &estimate::EstimatorTraits::needs_system)),
      stops_early(scene.solver.stopping == scene::SolverParameters::Stopping::discretisation
                  && !any_estimator(scene, plan, &estimate::EstimatorTraits::needs_equilibrium)),
      mesh_maker(scene, communicator, log)
  {
  }

  void
  Driver::run()
  {
    if (is_first_rank(communicator))
      for (Observer *observer : observers)
        observer->run_started(scene);

    make_initial_mesh(0);
    make_reference();
    if (!stops_early && scene.solver.stopping == scene::SolverParameters::Stopping::discretisation)
      log.info(
        "Solver/Stopping = discretisation is not followed: an estimator needs the solution of "
        "the discrete equations. Conjugate gradients go on to Solver/Tolerance.");
    const StopDecision decision = run_cycles();
    for (const Doubt &doubt : doubts)
      log.warning("last cycle: " + doubt.what + " " + doubt.advice);
    core::on_first_rank(communicator, [&]() {
      for (Observer *observer : observers)
        observer->run_done(decision);
    });
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
    use(mesh_maker.initial(number));
    // The reference keeps the first mesh's map; a later mesh may have no region
    // that this one does not know.
    if (materials == nullptr)
      materials = std::make_unique<mechanics::MaterialMap>(scene, *mesh);
    if (number == 0 && plan.needs(Plan::sizing))
      {
        const std::string reason = scene.adaptivity.safeguard ? why_energy_cannot_tell(scene, *mesh)
                                                              : "Adaptivity/Safeguard = no";
        is_tested                = reason.empty();
        if (!is_tested)
          log.detail("Meshes are accepted without comparing their energy: " + reason + ".");
      }
    warn_of_flat_cells();
    check_placement(scene, mesh, log);
    before.reset();
    expect_error(0.);
    log.info((number == 0 ? "Mesh: " : "Mesh " + std::to_string(number) + ": ")
             + describe_mesh(*mesh, current.record));
    if (number == 0)
      {
        // Large deformation has no errors to leave something out of.
        if (materials->is_linear())
          excluded = compare::ExcludedRegion(scene, *mesh);
        for (const auto &text : describe_left_out(left_out_of(excluded, *mesh)))
          log.info(text);
      }
  }

  void
  Driver::warn_of_flat_cells() const
  {
    const double angle = current.record.min_dihedral;
    if (!(angle < flat_angle))
      return;
    std::ostringstream text;
    text << "The mesh has nearly flat tetrahedra, with dihedral angles down to " << angle
         << " degrees: results and estimates lose digits there, the estimator 'equilibrated' most "
            "of all. Repair the mesh in the program that made it.";
    log.warning(text.str());
  }

  void
  Driver::make_reference()
  {
    if (!plan.uses_reference())
      return;
    const auto scope = timer.scope("reference");
    reference        = std::make_unique<compare::Reference>(
      adapt::make_reference(scene, *materials, *mesh, communicator, log, excluded));
    sampling = std::make_shared<compare::ReferenceSampling>(reference->displacement,
                                                            *materials,
                                                            communicator,
                                                            excluded);
    std::ostringstream text;
    text << "Reference: " << reference->description << "; estimated relative energy error ";
    const mechanics::EnergyNorm norm{sampling->energy_norm(), sampling->energy_noise()};
    if (const auto relative = norm.relative(reference->estimated_error))
      text << *relative;
    else
      text << "unknown, for it has no stress";
    if (plan.needs(Plan::known_energy) && !materials->has_thermal_strain())
      {
        // What is known is sharper than what is estimated.
        const auto known
          = estimate::error_from_known_energy(2. * scene.exact_solution.strain_energy,
                                              reference->energy,
                                              drive);
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
    cycle.record.cycle    = number;
    cycle.record.mesh     = current.record;
    cycle.record.left_out = left_out_of(excluded, *mesh);
    std::shared_ptr<const solve::StaticSystem> system;
    {
      const auto                scope = timer.scope("solve");
      solve::StaticSystem::Stop stop;
      if (stops_early)
        stop.algebraic_error = solver_error(scene.solver.solver_error_fraction);
      system = std::make_shared<solve::StaticSystem>(
        scene, *materials, mesh, scene.degree, communicator, in_cycle(number));
      const auto start = make_start(*system);
      cycle.solution   = system->solve(start.get(), stop);
      // The energy is 2 F - a without displacements that are prescribed: StaticSolution.
      cycle.energy = {system->is_driven_by_loads()
                        ? -0.5 * cycle.solution.energy
                        : 0.5 * cycle.solution.energy - cycle.solution.external_work,
                      cycle.solution.algebraic_error};
    }
    cycle.record.points           = mesh->n_points();
    cycle.record.tets             = mesh->n_cells();
    cycle.record.dofs             = cycle.solution.n_dofs;
    cycle.record.energy           = cycle.solution.energy;
    cycle.record.strain_energy    = cycle.solution.strain_energy;
    cycle.record.spring_energy    = cycle.solution.spring_energy;
    cycle.record.max_displacement = cycle.solution.displacement->largest_norm();
    cycle.record.iterations       = cycle.solution.iterations;
    if (cycle.solution.iterations > 0)
      {
        cycle.record.iterations_to_tolerance = cycle.solution.iterations_to_tolerance;
        cycle.record.algebraic_error         = cycle.solution.algebraic_error;
      }
    check_range(cycle.record);
    describe_loads(scene,
                   cycle.solution.loads,
                   history.empty() ? std::vector<LoadRecord>() : history.front().loads,
                   cycle.record);
    for (const std::string &line : load_lines(cycle.record))
      log.detail(line);
    {
      const auto scope = timer.scope("estimate");
      doubts           = doubts_about(*cycle.solution.displacement, scene);
      for (const Doubt &doubt : doubts_about_loads(cycle.record))
        doubts.push_back(doubt);
      for (const Doubt &doubt : doubts)
        log.warning("cycle " + std::to_string(number) + ": " + doubt.what);
    }
    {
      const auto        scope = timer.scope("reactions");
      const std::string warning
        = describe_solution(*system, cycle.solution, *materials, cycle.record);
      if (!warning.empty())
        log.warning(warning);
      for (const auto &text : reaction_warnings(cycle.record))
        log.warning("cycle " + std::to_string(number) + ": " + text);
    }
    if (keeps_system)
      cycle.solution.system = system;
    system.reset();
    cycle.comparison    = std::make_shared<estimate::Comparison>(cycle.solution.displacement,
                                                              *materials,
                                                              scene.exact_solution,
                                                              sampling,
                                                              communicator,
                                                              excluded);
    cycle.solution.norm = norm_outside(*cycle.comparison, cycle.solution.norm);
    if (plan.needs(Plan::vtu_output))
      cycle.comparison->displacement(); // the first rank alone could not get it when it writes
    return cycle;
  }

  void
  Driver::check_range(const CycleRecord &record) const
  {
    const char *advice = " Choose units in which loads, Young moduli and lengths are neither tiny "
                         "nor huge.";
    if (!std::isfinite(record.energy) || !std::isfinite(record.strain_energy)
        || !std::isfinite(record.max_displacement))
      throw core::NumericalError("The solution is not finite: the product of loads, material "
                                 "constants and lengths leaves the range of double precision."
                                 + std::string(advice));
    double modulus = 0.;
    for (const auto &material : scene.materials)
      modulus = std::max(modulus, material.moduli_at_rest().young_modulus);
    const auto   box    = mesh::bounding_box(*mesh);
    const double extent = (box.second - box.first).norm();
    // A body that moves as a whole has no energy; it would have this one if it were strained.
    const double possible = modulus * extent * record.max_displacement * record.max_displacement;
    if (std::abs(record.energy) > largest_energy
        || (record.max_displacement > 0. && possible < smallest_energy))
      {
        std::ostringstream text;
        text << "The largest displacement is " << record.max_displacement << " and the energy "
             << record.energy << "; errors can be computed for energies between " << smallest_energy
             << " and " << largest_energy << '.' << advice;
        throw core::NumericalError(text.str());
      }
  }

  void
  Driver::compare_and_estimate(Cycle &cycle)
  {
    {
      const auto scope = timer.scope("estimate");
      in_cycle(cycle.record.cycle).progress("comparing and estimating");
      levels.push_back({cycle.solution.n_dofs, cycle.solution.energy});
      MeasuredErrors measured     = measure_errors({scene, plan, drive, reference.get()},
                                               {cycle.solution, *cycle.comparison, levels},
                                               cycle.record);
      cycle.wanted_indicator_norm = measured.wanted_indicator_norm;
      cycle.indicators            = std::move(measured.indicators);
      if (!measured.warning.empty())
        log.warning(measured.warning);
    }
    cycle.solution.system.reset();
  }

  void
  Driver::set_seconds(CycleRecord &record) const
  {
    // Since the last cycle ended, so that a row tells what the cycle cost.
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
    const auto                 scope       = timer.scope("output");
    const bool                 is_accepted = cycle.record.acceptance == Acceptance::accepted;
    const std::vector<double> *ren
      = is_accepted && plan.needs(Plan::nodal_ren) ? &cycle.comparison->ren().values : nullptr;
    std::vector<double> sizes;
    if (plan.needs(Plan::size_field_output))
      sizes = obtained_sizes(*mesh);
    const mesh::NodalField *displacement
      = plan.needs(Plan::vtu_output) ? &cycle.comparison->displacement() : nullptr;
    const CycleEvent event{cycle.record,
                           *mesh,
                           displacement,
                           *materials,
                           cycle.indicators.empty() ? nullptr : &cycle.indicators,
                           ren,
                           sizes.empty() ? nullptr : &sizes};
    for (Observer *observer : observers)
      observer->cycle_done(event);
    std::ostringstream text;
    text << "Cycle " << cycle.record.cycle << ": " << cycle.solution.solver;
    if (cycle.record.iterations > 0)
      text << ", " << cycle.record.iterations << " iterations";
    if (cycle.record.iterations_to_tolerance > cycle.record.iterations)
      text << " instead of about " << cycle.record.iterations_to_tolerance
           << " to Solver/Tolerance: the remaining error, " << *cycle.record.algebraic_error
           << " in the energy norm, is small compared with the error of the mesh";
    log.detail(text.str());
  }

  StopDecision
  Driver::decide_by_rules(const Cycle &cycle) const
  {
    StoppingContext context;
    context.degree            = scene.degree;
    context.true_energy_error = is_true(cycle.record.error_source);
    context.true_ren          = plan.needs(Plan::exact_comparison);
    context.goal              = scene.estimation.goal;
    context.leaves_out        = !excluded.empty();
    context.n_meshes          = scene.mesh.n_meshes();
    context.elapsed_seconds   = timer.total_wall();
    if (reference != nullptr)
      {
        context.reference_tets   = reference->displacement.n_tetrahedra();
        context.reference_degree = reference->displacement.degree();
        context.reference_is_hexahedra
          = scene.reference.type == scene::ReferenceParameters::Type::hexahedra;
      }
    // Clocks differ from rank to rank; the decision must not.
    core::broadcast_bytes(&context.elapsed_seconds, sizeof(double), communicator);
    std::vector<CycleRecord> cycles;
    for (const CycleRecord &record : history)
      if (record.acceptance == Acceptance::accepted)
        cycles.push_back(record);
    return decide_stop(scene.adaptivity, context, cycles);
  }

  void
  Driver::solve(const unsigned int number)
  {
    present = solve_cycle(number);
  }

  void
  Driver::estimate()
  {
    Cycle     &cycle       = *present;
    const bool by_estimate = accepted && compares_estimates(cycle);
    if (by_estimate || !is_rejected_by_energy(cycle))
      compare_and_estimate(cycle);
    if (by_estimate)
      reject_by_estimate(cycle);
    set_seconds(cycle.record);
    history.push_back(cycle.record);
    core::on_first_rank(communicator, [&]() { announce(cycle); });
  }

  StopDecision
  Driver::decide()
  {
    StopDecision decision;
    if (present->record.acceptance == Acceptance::rejected)
      ++n_rejected;
    else
      {
        decision = decide_by_rules(*present);
        for (const auto &warning : decision.warnings)
          log.warning("cycle " + std::to_string(present->record.cycle) + ": " + warning);
        if (decision.stop())
          return decision;
        n_rejected = 0;
        accepted   = std::move(present);
      }
    present.reset();
    return decision;
  }
} // namespace tetradapt::adapt
