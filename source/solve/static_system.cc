// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/static_system.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/fem/triangulation.h"

#include "tetradapt/mechanics/loads.h"
#include "tetradapt/mechanics/rigid_motions.h"
#include "tetradapt/mechanics/springs.h"
#include "tetradapt/solve/energies.h"
#include "tetradapt/solve/linear_solver.h"
#include "tetradapt/solve/mixed_solver.h"
#include "tetradapt/solve/nonlinear_solver.h"
#include "tetradapt/solve/static_solution.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::solve
{
  namespace
  {
    std::shared_ptr<const mesh::EdgeTable>
    edges_for(const mesh::TetMesh &mesh, unsigned int degree)
    {
      return degree == 2 ? std::make_shared<const mesh::EdgeTable>(mesh::build_edges(mesh))
                         : nullptr;
    }

    dealii::Tensor<1, 3>
    at_node(const Vector &vector, const unsigned int node)
    {
      dealii::Tensor<1, 3> value;
      for (unsigned int c = 0; c < 3; ++c)
        value[c] = vector.local_element(3 * node + c);
      return value;
    }

    /** The estimated algebraic error may be too small; a norm that is not well above it
     * is noise. */
    constexpr double algebraic_noise = 10.;

    mechanics::EnergyNorm
    norm_of(const Energies &energies, const double square, const LinearResult &result)
    {
      mechanics::EnergyNorm norm;
      norm.value = std::sqrt(std::max(0., square));
      norm.noise = mechanics::EnergyNorm::rounding * std::sqrt(energies.scale)
                   + algebraic_noise * result.algebraic_error;
      return norm;
    }

    /** Sum of the lengths of @p forces at the free unknowns. */
    double
    free_magnitude(const fem::Space                        &space,
                   const mechanics::PrescribedDisplacement &prescribed,
                   const Vector                            &forces)
    {
      double sum = 0.;
      for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
        sum += prescribed.free_part(space.field_node(node), at_node(forces, node)).norm();
      return dealii::Utilities::MPI::sum(sum, space.communicator());
    }
  } // namespace

  struct StaticSystem::Data
  {
    Data(const scene::Scene                  &scene,
         const mechanics::MaterialMap        &materials,
         std::shared_ptr<const mesh::TetMesh> mesh_pointer,
         unsigned int                         degree,
         MPI_Comm                             communicator,
         const core::Log                     &caller_log)
      : scene(scene), materials(materials), mesh(std::move(mesh_pointer)), log(caller_log),
        edges(edges_for(*mesh, degree)),
        prescribed(mechanics::prescribe(scene.supports, *mesh, edges.get(), scene.mesh)),
        springs(scene, *mesh),
        kept(materials.is_mixed()
               ? std::make_unique<mechanics::MaterialMap>(kept_scene(scene), *mesh)
               : nullptr)
    {
      if (!springs.empty())
        mechanics::check_rigid_motions(*mesh, prescribed, &springs);
      space = std::make_shared<const fem::Space>(
        std::make_shared<const fem::Triangulation>(mesh, communicator), degree, edges);
      constraints = mechanics::make_constraints(prescribed, *space);
      fixed       = std::make_unique<fem::FixedUnknowns>(*space, constraints);
      log.progress("assembling " + std::to_string(space->n_dofs()) + " unknowns");
      mechanics::NodalLoads loads
        = mechanics::assemble_loads(scene, kept ? *kept : materials, *space);
      forces = std::move(loads.forces);
      mechanics::add_rigid_forces(scene.supports, prescribed, *space, forces);
      load_totals = std::move(loads.totals);
      couplings   = std::make_unique<mechanics::RigidCouplings>(prescribed.rigid, *space);
      if (!materials.is_linear())
        {
          nonlinear_solver = std::make_unique<NonlinearSolver>(
            NonlinearModel{*space, materials, prescribed, forces}, scene.solver, log);
          return;
        }
      tangents = std::make_unique<mechanics::TangentField>(kept ? *kept : materials, *mesh);
      solver   = std::make_unique<LinearSolver>(
        LinearModel{*space, *tangents, constraints, couplings.get(), &springs}, scene.solver, log);
      if (materials.is_mixed())
        mixed_solver
          = std::make_unique<MixedSolver>(MixedModel{space, materials, prescribed, *fixed, *solver},
                                          scene.solver,
                                          log);
    }

    /** The forces on the nodes of loads and, where it moves, of the ground under springs. */
    Vector
    applied_forces() const
    {
      Vector sum(forces);
      if (springs.have_moved_ground())
        sum += mechanics::spring_forces(springs, fem::Field(space)).nodal;
      return sum;
    }

    /** int eps(u) : C : eps(u) and, with springs, what they have of their own: Energies of the
     * body, the springs' after that. */
    std::pair<Energies, double>
    energies_of(const fem::Field &u) const
    {
      return {compute_energies(u, materials), mechanics::spring_forces(springs, u).energy};
    }

    /** With springs an error relative to the energy of all says nothing of the body on soft ones:
     * then the residual's tolerance counts. */
    LinearStop
    stop_of(const Stop &stop) const
    {
      return {stop.residual, stop.algebraic_error, springs.empty() ? stop.relative_error : 0., {}};
    }

    /** Whether nothing moves but what loads move. */
    bool
    is_driven_by_loads() const
    {
      return prescribed.is_homogeneous() && !springs.have_moved_ground();
    }

    /** The unknowns with a value of @p free where they are free, if it is not null,
     * and the prescribed ones times @p factor elsewhere. Collective. */
    Vector
    vector_of(const Vector *free, double factor) const
    {
      Vector x(space->vector_layout());
      for (unsigned int node = 0; node < space->n_owned_nodes(); ++node)
        {
          const unsigned int field_node = space->field_node(node);
          for (unsigned int c = 0; c < 3; ++c)
            if (prescribed.is_fixed(field_node, c))
              x.local_element(3 * node + c) = factor * prescribed.values[field_node][c];
            else if (free != nullptr)
              x.local_element(3 * node + c) = free->local_element(3 * node + c);
          if (prescribed.fixed[field_node] == mechanics::PrescribedDisplacement::is_inclined)
            {
              dealii::Tensor<1, 3> value = factor * prescribed.values[field_node];
              if (free != nullptr)
                value += prescribed.free_part(field_node, at_node(*free, node));
              for (unsigned int c = 0; c < 3; ++c)
                x.local_element(3 * node + c) = value[c];
            }
        }
      if (!couplings->empty())
        {
          // Free motions of a start that has the prescribed ones.
          couplings->add_prescribed(-factor, x);
          couplings->project(x);
          couplings->add_prescribed(factor, x);
        }
      return x;
    }

    void
    solve_nonlinear(Vector x, StaticSolution &solution);

    const scene::Scene                    &scene;
    const mechanics::MaterialMap          &materials;
    std::shared_ptr<const mesh::TetMesh>   mesh;
    core::Log                              log;
    std::shared_ptr<const mesh::EdgeTable> edges;
    mechanics::PrescribedDisplacement      prescribed;
    mechanics::Springs                     springs;
    /** Mixed form only: the materials without what the pressure carries. */
    std::unique_ptr<mechanics::MaterialMap>  kept;
    std::unique_ptr<mechanics::TangentField> tangents;    ///< of linear laws
    std::shared_ptr<const fem::Space>        space;       ///< of solutions also
    fem::Constraints                         constraints; ///< of the supports
    std::unique_ptr<fem::FixedUnknowns>      fixed;       ///< by constraints
    Vector                                   forces;      ///< of the loads
    std::vector<mechanics::LoadTotal>        load_totals;
    /** Of laws that are not linear, at the last solution. */
    Vector internal_forces;
    /** Of these: the resultants of the loads at the deformed positions. */
    std::vector<mechanics::Resultant>          deformed_loads;
    std::unique_ptr<mechanics::RigidCouplings> couplings;
    std::unique_ptr<LinearSolver>              solver;           ///< of linear laws
    std::unique_ptr<MixedSolver>               mixed_solver;     ///< mixed form only
    std::unique_ptr<NonlinearSolver>           nonlinear_solver; ///< of laws that are not linear
  };

  /** The part of solve() for laws that are not linear. */
  void
  StaticSystem::Data::solve_nonlinear(Vector x, StaticSolution &solution)
  {
    const NonlinearResult result = nonlinear_solver->solve(x);
    internal_forces              = nonlinear_solver->internal_forces(x);
    solution.external_work       = forces * x;
    solution.displacement        = std::make_shared<const fem::Field>(space, std::move(x));
    deformed_loads.clear();
    for (const auto &total :
         mechanics::assemble_loads(scene, materials, *space, solution.displacement.get()).totals)
      deformed_loads.push_back(total.resultant);
    solution.strain_energy = result.stored_energy;
    solution.energy        = prescribed.is_homogeneous()
                               ? 2. * (solution.external_work - result.stored_energy)
                               : 2. * result.stored_energy;
    solution.norm.value    = std::sqrt(2. * std::max(0., result.stored_energy));
    solution.norm.noise    = mechanics::EnergyNorm::rounding * solution.norm.value
                          + algebraic_noise * result.algebraic_error;
    solution.algebraic_error         = result.algebraic_error;
    solution.iterations              = result.linear_iterations;
    solution.iterations_to_tolerance = result.linear_iterations;
    solution.solver = "Newton's method, " + std::to_string(result.steps) + " steps in "
                      + std::to_string(result.load_steps) + " of the load";
    if (result.vain_steps > 0)
      solution.solver += " and " + std::to_string(result.vain_steps) + " in vain";
    double sum = 0.;
    for (unsigned int node = 0; node < space->n_owned_nodes(); ++node)
      sum += at_node(internal_forces, node).norm();
    solution.load_magnitude = dealii::Utilities::MPI::sum(sum, space->communicator());
  }

  StaticSystem::StaticSystem(const scene::Scene                  &scene,
                             const mechanics::MaterialMap        &materials,
                             std::shared_ptr<const mesh::TetMesh> mesh,
                             unsigned int                         degree,
                             MPI_Comm                             communicator,
                             const core::Log                     &log)
    : data(std::make_unique<Data>(scene, materials, std::move(mesh), degree, communicator, log))
  {
  }

  StaticSystem::~StaticSystem() = default;

  StaticSolution
  StaticSystem::solve(const fem::Field *start, const Stop &stop) const
  {
    const fem::Space &space = *data->space;
    StaticSolution    solution;
    solution.n_dofs = space.n_dofs();
    solution.loads  = data->load_totals;

    // Where laws are not linear, prescribed values are approached from the last ones.
    Vector x = data->vector_of(start == nullptr ? nullptr : &start->vector(),
                               data->nonlinear_solver && start == nullptr ? 0. : 1.);
    if (data->nonlinear_solver)
      {
        data->solve_nonlinear(std::move(x), solution);
        return solution;
      }
    const bool   with_springs    = !data->springs.empty();
    const Vector right_hand_side = data->solver->right_hand_side(data->applied_forces());
    LinearStop   linear_stop     = data->stop_of(stop);
    LinearResult result;
    std::shared_ptr<const fem::Pressure> pressure;
    if (data->mixed_solver)
      {
        const auto &pressures = data->mixed_solver->space();
        Vector      p(pressures->vector_layout());
        if (start != nullptr && start->pressure())
          {
            p = start->pressure()->vector();
            p.zero_out_ghost_values();
          }
        result   = data->mixed_solver->solve(right_hand_side, linear_stop, x, p);
        pressure = std::make_shared<const fem::Pressure>(pressures, std::move(p));
        solution.n_dofs += pressures->n_dofs();
      }
    else
      {
        // On soft springs the energy of the body is a small part of all.
        if (!data->prescribed.is_homogeneous() || with_springs)
          linear_stop.energy = [&](const Vector &iterate) {
            return compute_energies(fem::Field(data->space, iterate), data->materials).energy;
          };
        result = data->solver->solve(right_hand_side, linear_stop, "The loads", x);
      }
    solution.iterations              = result.iterations;
    solution.iterations_to_tolerance = result.iterations_to_residual;
    solution.algebraic_error         = result.algebraic_error;
    solution.solver                  = result.description;
    solution.load_magnitude          = free_magnitude(space, data->prescribed, right_hand_side);
    solution.external_work           = data->forces * x;
    solution.displacement
      = std::make_shared<const fem::Field>(data->space, std::move(x), std::move(pressure));

    const auto [energies, spring_energy] = data->energies_of(*solution.displacement);
    const double all_energy              = energies.energy + 2. * spring_energy;
    if (with_springs)
      solution.spring_energy = spring_energy;
    // In mixed form temperatures load the pressure's equation also, which that work leaves out.
    const bool thermal = data->materials.has_thermal_strain();
    const bool by_work = data->is_driven_by_loads() && !(thermal && data->materials.is_mixed());
    solution.energy    = by_work ? 2. * solution.external_work - all_energy : all_energy;
    solution.strain_energy
      = by_work && !thermal && !with_springs ? 0.5 * solution.energy : energies.stored;
    solution.norm
      = norm_of(energies, thermal || with_springs ? 2. * energies.stored : solution.energy, result);
    return solution;
  }

  std::shared_ptr<const fem::Field>
  StaticSystem::solve_dual(const Vector &forces, const Stop &stop) const
  {
    require_linear();
    Vector       x = data->vector_of(nullptr, 0.);
    const Vector b = data->vector_of(&forces, 0.);
    data->solver->solve(b, data->stop_of(stop), "The weights of the goal", x);
    return std::make_shared<const fem::Field>(data->space, std::move(x));
  }

  void
  StaticSystem::precondition(const Vector &forces, Vector &displacement) const
  {
    require_linear();
    displacement.reinit(data->space->vector_layout());
    data->solver->precondition(displacement, data->vector_of(&forces, 0.));
  }

  void
  StaticSystem::require_linear() const
  {
    if (data->nonlinear_solver)
      throw core::InputError("Dual problems and corrections are solved for laws of small strains "
                             "only. Leave out the estimators that need them.");
  }

  const Vector &
  StaticSystem::nodal_forces() const
  {
    return data->forces;
  }

  const std::shared_ptr<const fem::Space> &
  StaticSystem::space() const
  {
    return data->space;
  }

  std::shared_ptr<const fem::PressureSpace>
  StaticSystem::pressure_space() const
  {
    return data->mixed_solver ? data->mixed_solver->space() : nullptr;
  }

  Equilibrium
  StaticSystem::equilibrium(const StaticSolution                        &solution,
                            const std::vector<mechanics::RegionFigures> &regions) const
  {
    std::vector<mechanics::Resultant> resultants = data->deformed_loads;
    if (resultants.empty())
      for (const auto &total : solution.loads)
        resultants.push_back(total.resultant);
    return compute_equilibrium({data->scene,
                                *data->space,
                                data->materials,
                                data->prescribed,
                                data->springs,
                                data->forces,
                                data->nonlinear_solver ? &data->internal_forces : nullptr,
                                resultants},
                               solution,
                               regions);
  }

  const mechanics::PrescribedDisplacement &
  StaticSystem::prescribed() const
  {
    return data->prescribed;
  }

  bool
  StaticSystem::is_driven_by_loads() const
  {
    return data->is_driven_by_loads();
  }
} // namespace tetradapt::solve
