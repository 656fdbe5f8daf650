// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_driver_h
#define tetradapt_adapt_driver_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/adapt/size_field.h"
#include "tetradapt/adapt/stopping.h"
#include "tetradapt/compare/reference.h"
#include "tetradapt/compare/reference_sampling.h"
#include "tetradapt/core/log.h"
#include "tetradapt/core/stage_timer.h"
#include "tetradapt/estimate/comparison.h"
#include "tetradapt/estimate/effectivity.h"
#include "tetradapt/scene/plan.h"
#include "tetradapt/solve/static_solution.h"

#include <mpi.h>

#include <functional>
#include <memory>

namespace tetradapt::adapt
{
  /**
   * Runs a scene: solve, compare, estimate, refine, until a stopping rule holds.
   * Does only what the plan lists as needed. Every rank of the communicator makes
   * one and calls run(); observers are told on the first rank only.
   */
  class Driver
  {
  public:
    /** Describes a mesh for the log; made by the report room. */
    using MeshDescription = std::function<std::string(const mesh::TetMesh &)>;

    /** Keeps references to all arguments, which must outlive it. */
    Driver(const scene::Scene            &scene,
           const scene::Plan             &plan,
           MPI_Comm                       communicator,
           const core::Log               &log,
           core::StageTimer              &timer,
           const std::vector<Observer *> &observers,
           MeshDescription                describe_mesh);

    /** Collective. @throws core::InputError, core::NumericalError. */
    void
    run();

  private:
    /** What one cycle computed; what the scene does not need is null. */
    struct Cycle
    {
      CycleRecord                           record;
      solve::StaticSolution                 solution;
      std::unique_ptr<estimate::Comparison> comparison;
      std::vector<double>                   indicators;
      bool true_energy_error = false; ///< energy_error is the true one
    };

    void
    make_initial_mesh(unsigned int number);
    void
    make_reference();
    Cycle
    solve_cycle(unsigned int number);
    void
    compare_and_estimate(Cycle &cycle);
    void
    announce(const Cycle &cycle);
    StopDecision
    decide(const Cycle &cycle) const;
    /** Replaces the mesh; the decision says why the loop ends if it cannot. */
    StopDecision
    next_mesh(Cycle &cycle);
    StopDecision
    adapt_mesh(Cycle &cycle);
    SizeField
    make_size_field(const Cycle &cycle) const;
    double
    wanted_indicator_norm(const Cycle &cycle) const;
    void
    refine_mesh(const SizeField &field, unsigned int number);
    /** The log, its progress beginning with a cycle's number. */
    core::Log
    in_cycle(unsigned int number) const;
    void
    prepare_start(Cycle &cycle);

    const scene::Scene            &scene;
    const scene::Plan             &plan;
    MPI_Comm                       communicator;
    const core::Log               &log;
    core::StageTimer              &timer;
    const std::vector<Observer *> &observers;
    MeshDescription                describe_mesh;
    estimate::Drive                drive;

    std::shared_ptr<const mesh::TetMesh>              mesh;
    std::unique_ptr<mechanics::MaterialMap>           materials;
    std::unique_ptr<compare::Reference>               reference;
    std::shared_ptr<const compare::ReferenceSampling> sampling;
    std::unique_ptr<mesh::NodalField>                 start; ///< first iterate of the next solve
    std::vector<CycleRecord>                          history;
    double obtained_over_predicted = 0.; ///< see SizeFieldOptions
  };
} // namespace tetradapt::adapt

#endif
