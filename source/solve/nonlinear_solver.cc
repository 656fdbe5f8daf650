// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/nonlinear_solver.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/solve/indefinite_matrix.h"
#include "tetradapt/solve/linear_solver.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::solve
{
  namespace
  {
    /** The smallest load step; so there are 4096 at most. */
    constexpr double smallest_step = 1. / 4096.;

    /** Newton steps up to which the next load step is made larger. */
    constexpr unsigned int easy = 6;

    /** Rounding of sums of energies, relative to their parts. */
    constexpr double rounding = 1e-13;
  } // namespace

  NonlinearSolver::NonlinearSolver(const NonlinearModel          &model,
                                   const scene::SolverParameters &parameters,
                                   const core::Log               &log)
    : model(model), parameters(parameters), log(log), stiffness(model.space, model.materials)
  {
  }

  bool
  NonlinearSolver::moves_prescribed(const double factor, const Vector &x) const
  {
    int moves = 0;
    for (unsigned int node = 0; node < model.space.n_owned_nodes(); ++node)
      {
        const unsigned int field_node = model.space.field_node(node);
        for (unsigned int c = 0; c < 3; ++c)
          if (model.prescribed.is_fixed(field_node, c))
            {
              const double wanted = factor * model.prescribed.values[field_node][c];
              const double has    = x.local_element(3 * node + c);
              // A step x + (wanted - x) may differ in the last digit.
              if (std::abs(wanted - has) > 1e-14 * std::max(std::abs(wanted), std::abs(has)))
                moves = 1;
            }
      }
    return dealii::Utilities::MPI::max(moves, model.space.communicator()) > 0;
  }

  Newton::State
  NonlinearSolver::residual(const double factor, const Vector &x, Vector &r) const
  {
    namespace MPI = dealii::Utilities::MPI;
    deformed      = stiffness.internal_forces(x, r);
    double free = 0., outer = 0., work = 0., parts = 0.;
    for (unsigned int node = 0; node < model.space.n_owned_nodes(); ++node)
      {
        const unsigned int field_node = model.space.field_node(node);
        for (unsigned int c = 0; c < 3; ++c)
          {
            double      &value    = r.local_element(3 * node + c);
            const double internal = value;
            const double external = factor * model.forces.local_element(3 * node + c);
            work += external * x.local_element(3 * node + c);
            parts += std::abs(external * x.local_element(3 * node + c));
            value = external - internal;
            if (model.prescribed.is_fixed(field_node, c))
              {
                outer += value * value; // a reaction
                value = 0.;
              }
            else
              {
                outer += external * external;
                free += value * value;
              }
          }
      }
    const MPI_Comm communicator = model.space.communicator();
    Newton::State  state;
    state.is_admissible = deformed.is_admissible;
    state.residual      = std::sqrt(MPI::sum(free, communicator));
    state.scale         = std::sqrt(MPI::sum(outer, communicator));
    state.potential     = deformed.stored_energy - MPI::sum(work, communicator);
    state.floor         = deformed.force_rounding;
    state.noise = rounding * (std::abs(deformed.stored_energy) + MPI::sum(parts, communicator))
                  + state.floor * x.l2_norm();
    return state;
  }

  unsigned int
  NonlinearSolver::solve_step(
    const double factor, const Vector &x, const Vector &r, const double tolerance, Vector &step)
  {
    const fem::Space                 &space = model.space;
    mechanics::PrescribedDisplacement missing;
    Vector                            forces(space.vector_layout());
    missing.fixed = model.prescribed.fixed;
    missing.values.resize(model.prescribed.values.size());
    // Ghosts also have to know what is prescribed.
    x.update_ghost_values();
    for (unsigned int node = 0; node < space.n_local_nodes(); ++node)
      {
        const unsigned int field_node = space.field_node(node);
        for (unsigned int c = 0; c < 3; ++c)
          if (model.prescribed.is_fixed(field_node, c))
            missing.values[field_node][c]
              = factor * model.prescribed.values[field_node][c] - x.local_element(3 * node + c);
          else if (node < space.n_owned_nodes())
            forces.local_element(3 * node + c) = r.local_element(3 * node + c);
      }
    x.zero_out_ghost_values();
    const fem::Constraints constraints = mechanics::make_constraints(missing, space);
    LinearSolver solver(LinearModel{space, *tangents, constraints, nullptr}, parameters, log);
    fem::FixedUnknowns(space, constraints).distribute(step);
    const Vector right_hand_side = solver.right_hand_side(forces);
    LinearStop   stop;
    stop.residual     = tolerance;
    const auto result = solver.solve(right_hand_side, stop, "The forces out of balance", step);
    last_error        = std::sqrt(std::max(0., r * step));
    last_residual     = r.l2_norm();
    return result.iterations;
  }

  Newton::Result
  NonlinearSolver::equilibrate(const double factor, Vector &x)
  {
    Newton newton;
    newton.residual       = [&](const Vector &at, Vector &r) { return residual(factor, at, r); };
    newton.setup_jacobian = [&](const Vector &at) {
      tangents = std::make_unique<mechanics::TangentField>(stiffness.linearise(at));
    };
    newton.solve_with_jacobian
      = [&](const Vector &at, const Vector &r, const double tolerance, Vector &step) {
          return solve_step(factor, at, r, tolerance, step);
        };
    newton.moves_prescribed = [&](const Vector &at) { return moves_prescribed(factor, at); };
    newton.progress         = [&](const unsigned int step, const double relative) {
      std::ostringstream text;
      text << "Newton step " << step << " at " << 100. * factor << " % of the load, residual "
           << relative;
      log.progress(text.str());
    };
    Newton::Limits limits;
    limits.tolerance      = parameters.tolerance;
    Newton::Result result = newton.solve(limits, x);
    if (result.ending == Newton::Ending::converged && !is_stable(x))
      result.ending = Newton::Ending::indefinite;
    return result;
  }

  bool
  NonlinearSolver::is_stable(const Vector &x)
  {
    const fem::Space                 &space = model.space;
    mechanics::PrescribedDisplacement held;
    held.fixed = model.prescribed.fixed;
    held.values.resize(model.prescribed.values.size());
    // Any forces in which no mode is missing; the same on any number of ranks.
    Vector forces(space.vector_layout());
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      {
        const unsigned int field_node = space.field_node(node);
        for (unsigned int c = 0; c < 3; ++c)
          if (!model.prescribed.is_fixed(field_node, c))
            forces.local_element(3 * node + c) = std::sin(1.7 * (3. * field_node + c) + 0.3);
      }
    const fem::Constraints constraints = mechanics::make_constraints(held, space);
    try
      {
        tangents = std::make_unique<mechanics::TangentField>(stiffness.linearise(x));
        LinearSolver solver(LinearModel{space, *tangents, constraints, nullptr}, parameters, log);
        Vector       step(x);
        step = 0.;
        LinearStop stop;
        stop.residual = 1e-3;
        solver.solve(solver.right_hand_side(forces), stop, "The forces", step);
      }
    catch (const IndefiniteMatrix &)
      {
        return false;
      }
    return true;
  }

  Vector
  NonlinearSolver::internal_forces(const Vector &x) const
  {
    Vector forces;
    stiffness.internal_forces(x, forces);
    return forces;
  }

  std::string
  NonlinearSolver::why(const Newton::Result &result) const
  {
    std::ostringstream text;
    switch (result.ending)
      {
      case Newton::Ending::inadmissible:
        text << "elements would be turned inside out, first near "
             << mesh::to_string(deformed.worst_place);
        break;
      case Newton::Ending::no_descent:
        text << "no step makes the potential energy lower: the body may have become unstable";
        break;
      case Newton::Ending::too_slow:
        text << "Newton's method did not converge in " << result.steps()
             << " steps; the residual is " << result.residuals.back() << " of the forces";
        break;
      case Newton::Ending::indefinite:
        text << "the tangent is not positive definite: the body is unstable, as where it buckles";
        break;
      case Newton::Ending::converged:
        break;
      }
    return text.str();
  }

  NonlinearResult
  NonlinearSolver::solve(Vector &x)
  {
    NonlinearResult result;
    Vector          last(x);
    last           = 0.;
    double reached = 0., size = 1.;
    bool   from_elsewhere = !x.all_zero(); // a guess, not the body at rest
    double at_floor       = 0.; // relative residual, where rounding ended the last load step
    while (reached < 1.)
      {
        const double   factor  = std::min(1., reached + size);
        Newton::Result attempt = equilibrate(factor, x);
        result.linear_iterations += attempt.linear_iterations;
        if (attempt.ending == Newton::Ending::converged)
          {
            stiffness.accept();
            result.steps += attempt.steps();
            ++result.load_steps;
            at_floor         = attempt.at_floor ? attempt.residuals.back() : 0.;
            reached          = factor;
            last             = x;
            result.residuals = attempt.residuals;
            if (attempt.steps() <= easy)
              size *= 2.;
            continue;
          }
        result.vain_steps += attempt.steps();
        const std::string reason = why(attempt);
        x                        = last;
        if (from_elsewhere)
          {
            log.detail("Newton's method does not converge from the last displacement: " + reason
                       + ". It begins again with the body at rest.");
            from_elsewhere = false;
            continue;
          }
        size *= 0.25;
        std::ostringstream text;
        text.precision(3);
        text << "at " << 100. * factor << " % of the load " << reason;
        log.detail("Newton's method: " + text.str() + ". The load is raised in smaller steps.");
        if (size < smallest_step)
          {
            std::ostringstream message;
            message.precision(3);
            message
              << "The body is in equilibrium up to " << 0.1 * std::floor(1000. * reached)
              << " % of the load only. A little above that, " << reason
              << ". Lower the loads or the prescribed displacements, use a finer mesh, or look "
                 "whether the body can buckle or tear there.";
            throw core::NumericalError(message.str());
          }
      }
    if (at_floor > parameters.tolerance)
      {
        std::ostringstream text;
        text << "The forces out of balance are " << at_floor
             << " of all, more than Solver/Tolerance: rounding leaves no less.";
        log.detail(text.str());
      }
    tangents.reset();
    Vector              r(x);
    const Newton::State state = residual(1., x, r);
    result.stored_energy      = deformed.stored_energy;
    // The error falls with the residual in the last step.
    if (last_residual > 0.)
      result.algebraic_error = last_error * std::min(1., state.residual / last_residual);
    return result;
  }
} // namespace tetradapt::solve
