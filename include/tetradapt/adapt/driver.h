// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_driver_h
#define tetradapt_adapt_driver_h

#include "tetradapt/adapt/acceptance.h"
#include "tetradapt/adapt/adaptive_loop.h"
#include "tetradapt/adapt/doubts.h"
#include "tetradapt/adapt/mesh_maker.h"
#include "tetradapt/adapt/observer.h"
#include "tetradapt/adapt/size_field.h"
#include "tetradapt/compare/reference.h"
#include "tetradapt/compare/reference_sampling.h"
#include "tetradapt/core/log.h"
#include "tetradapt/core/stage_timer.h"
#include "tetradapt/estimate/comparison.h"
#include "tetradapt/estimate/effectivity.h"
#include "tetradapt/estimate/estimator.h"
#include "tetradapt/scene/plan.h"
#include "tetradapt/solve/static_solution.h"

#include <mpi.h>

#include <functional>
#include <memory>
#include <optional>

namespace tetradapt::adapt
{
  /**
   * Runs a scene: solve, compare, estimate, refine, until a stopping rule holds.
   * Does only what the plan lists as needed.
   *
   * An adaptive cycle whose potential energy is not below that of the cycle before (where loads or
   * volume changed, whose estimate is above) is rejected: another mesh is made from the mesh
   * before, at first refined more strongly, then uniformly. A rejected cycle stays in the records,
   * without errors. Every rank of the communicator makes one and calls run(); observers are told on
   * the first rank only.
   */
  class Driver : private AdaptiveLoop
  {
  public:
    /** Describes a mesh for the log; made by the report room. */
    using MeshDescription = std::function<std::string(const mesh::TetMesh &, const MeshRecord &)>;

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
      std::shared_ptr<estimate::Comparison> comparison;
      std::vector<double>                   indicators;
      double                                wanted_indicator_norm = 0.; ///< see MeasuredErrors
      CycleEnergy                           energy;
    };

    void
    make_initial_mesh(unsigned int number);
    void
    make_reference();
    Cycle
    solve_cycle(unsigned int number);
    void
    warn_of_flat_cells() const;
    /** @throws core::NumericalError if the solution is not finite or its energy leaves the
     * range in which errors can be told. */
    void
    check_range(const CycleRecord &record) const;
    /** Whether the loads or the volume changed too much since the accepted cycle for energies
     * to tell which mesh is better. */
    bool
    compares_estimates(const Cycle &cycle) const;
    /** Whether the cycle is worse than the one that its mesh was made from. */
    bool
    is_rejected_by_energy(Cycle &cycle);
    /** Rejects it if it is worse by the refinement indicator; after compare_and_estimate(). */
    void
    reject_by_estimate(Cycle &cycle);
    /** Says why a cycle is worse. @return whether it is rejected. */
    bool
    reject(Cycle &cycle, const std::string &reason);
    void
    compare_and_estimate(Cycle &cycle);
    void
    set_seconds(CycleRecord &record) const;
    void
    announce(const Cycle &cycle);
    /** Whether an accepted cycle ends the loop. */
    StopDecision
    decide_by_rules(const Cycle &cycle) const;

    void
    solve(unsigned int number) override;
    void
    estimate() override;
    StopDecision
    decide() override;
    StopDecision
    mark() override;
    StopDecision
    refine() override;

    /** These make a mesh from the accepted cycle. */
    StopDecision
    mark_accepted(Cycle &cycle);
    /** Returns to its mesh, for another one in the place of the rejected. */
    StopDecision
    mark_rejected(Cycle &cycle);
    StopDecision
    next_mesh(Cycle &cycle);
    StopDecision
    adapt_mesh(Cycle &cycle);
    SizeField
    make_size_field(const Cycle &cycle, bool stronger) const;
    void
    refine_mesh(Cycle &cycle, bool from_scratch);
    void
    refine_uniformly(Cycle &cycle);
    void
    use(NewMesh made);
    /** Predicts the error of the next cycle from this one's, given the factor by which
     * it falls. */
    void
    predict_error(const CycleRecord &record, double factor);
    /** The log, its progress beginning with a cycle's number. */
    core::Log
    in_cycle(unsigned int number) const;
    /** Keeps what the next solve starts from. */
    void
    prepare_start(const Cycle &cycle);
    /** The last displacement in the space of @p system; null: none was kept. */
    std::shared_ptr<const fem::Field>
    make_start(const solve::StaticSystem &system);

    const scene::Scene            &scene;
    const scene::Plan             &plan;
    MPI_Comm                       communicator;
    const core::Log               &log;
    core::StageTimer              &timer;
    const std::vector<Observer *> &observers;
    MeshDescription                describe_mesh;
    estimate::Drive                drive;
    bool                           keeps_system; ///< an estimator solves with it again
    bool                           stops_early;  ///< the solver, by the error of the mesh

    MeshMaker                                         mesh_maker;
    NewMesh                                           current; ///< what is known of the mesh
    std::shared_ptr<const mesh::TetMesh>              mesh;
    std::unique_ptr<mechanics::MaterialMap>           materials;
    std::unique_ptr<compare::Reference>               reference;
    std::shared_ptr<const compare::ReferenceSampling> sampling;
    compare::ExcludedRegion                           excluded; ///< what errors leave out
    /** Of the cycle that the present mesh was made from, until the next solve has started. */
    std::shared_ptr<estimate::Comparison> before;
    std::vector<CycleRecord>              history;
    std::vector<estimate::EnergyLevel>    levels;  ///< accepted meshes only
    std::vector<Doubt>                    doubts;  ///< about the last solution
    std::optional<Cycle>                  present; ///< while it is not decided on
    /** The cycle that the next mesh is made from; once it is made, while that can be rejected. */
    std::optional<Cycle> accepted;
    unsigned int         n_rejected = 0;               ///< since then
    bool                 is_tested  = false;           ///< energies tell which mesh is better
    SizeField            sizes;                        ///< for the next mesh
    double               obtained_over_predicted = 0.; ///< see SizeFieldOptions
    /** What the size field of this mesh predicted of the error, and from where; 0: nothing. */
    double predicted_reduction = 0., predicted_from = 0.;
    double reduction_power = 1.; ///< see SizeFieldOptions
  };
} // namespace tetradapt::adapt

#endif
