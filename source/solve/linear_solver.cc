// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/linear_solver.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/solve/direct_solver.h"
#include "tetradapt/solve/preconditioners.h"

#include <deal.II/lac/solver_cg.h>

#include <cmath>
#include <sstream>

namespace tetradapt::solve
{
  namespace
  {
    /** Norm of the load that the free unknowns feel: what is left of the residual
     * when only the prescribed displacements are applied. */
    double
    load_norm(const LinearModel &model, const mechanics::LinearSystem &system)
    {
      double sum = 0.;
      for (unsigned int node = 0; node < model.space.n_owned_nodes(); ++node)
        for (unsigned int c = 0; c < 3; ++c)
          if (!model.prescribed.is_fixed(model.space.field_node(node), c))
            sum += std::pow(system.right_hand_side.local_element(3 * node + c), 2);
      return std::sqrt(dealii::Utilities::MPI::sum(sum, model.space.communicator()));
    }

    /** Preconditioner with what it refers to. */
    struct PreconditionerSet
    {
      std::unique_ptr<mechanics::DisplacementSpace> coarse_space;
      std::unique_ptr<Preconditioner>               preconditioner;
      std::string                                   name;
    };

    PreconditionerSet
    make_preconditioner(const LinearModel &model, const mechanics::LinearSystem &system)
    {
      PreconditionerSet set;
      if (model.space.degree() == 1)
        {
          set.preconditioner = make_amg(system.matrix, model.space, model.prescribed);
          set.name           = "AMG";
        }
      else
        {
          set.coarse_space
            = std::make_unique<mechanics::DisplacementSpace>(model.partition, 1, nullptr);
          const auto coarse
            = mechanics::assemble(*set.coarse_space, model.materials, model.prescribed, nullptr);
          set.preconditioner = make_p_multigrid(
            system.matrix, model.space, coarse.matrix, *set.coarse_space, model.prescribed);
          set.name = "p-multigrid on AMG";
        }
      return set;
    }

    unsigned int
    iterate(const mechanics::LinearSystem &system,
            const Preconditioner          &preconditioner,
            double                         tolerance,
            const scene::SolverParameters &parameters,
            const core::Log               &log,
            Vector                        &x)
    {
      dealii::SolverControl    control(parameters.max_iterations, tolerance, false, false);
      dealii::SolverCG<Vector> cg(control);
      cg.connect([&](unsigned int iteration, double residual, const Vector &) {
        std::ostringstream text;
        text << "conjugate gradients, iteration " << iteration << ", residual over tolerance "
             << residual / tolerance;
        log.progress(text.str());
        return dealii::SolverControl::success;
      });
      try
        {
          cg.solve(system.matrix, x, system.right_hand_side, preconditioner);
        }
      catch (const dealii::SolverControl::NoConvergence &failure)
        {
          std::ostringstream message;
          message << "Conjugate gradients did not converge: after " << failure.last_step
                  << " iterations the residual is " << failure.last_residual / tolerance
                  << " times the allowed one. Look for materials of very different stiffness, a "
                     "Poisson ratio close to 0.5 or very flat elements; or raise Solver/Maximum "
                     "iterations, or set Solver/Type = direct.";
          throw core::NumericalError(message.str());
        }
      return control.last_step();
    }
  } // namespace

  LinearResult
  solve_linear(const LinearModel             &model,
               const mechanics::LinearSystem &system,
               const scene::SolverParameters &parameters,
               const core::Log               &log,
               Vector                        &x)
  {
    using Type = scene::SolverParameters::Type;
    const bool direct
      = parameters.type == Type::direct
        || (parameters.type == Type::automatic && model.space.n_dofs() <= parameters.direct_limit);
    if (direct)
      {
        log.progress("factorising");
        solve_directly(system.matrix, model.space, system.right_hand_side, x);
        return {0, "direct (KLU)"};
      }
    log.progress("building the preconditioner");
    const double            norm = load_norm(model, system);
    const PreconditionerSet set  = make_preconditioner(model, system);
    if (!std::isfinite(norm))
      throw core::NumericalError("The loads are not finite. Look at the values of the loads and at "
                                 "the material constants.");
    if (norm == 0.)
      {
        // Nothing moves but what is prescribed, and that moves nothing else.
        x = 0.;
        for (unsigned int node = 0; node < model.space.n_owned_nodes(); ++node)
          for (unsigned int c = 0; c < 3; ++c)
            x.local_element(3 * node + c)
              = model.prescribed.values[model.space.field_node(node)][c];
        return {0, "nothing to solve: no load"};
      }
    LinearResult result;
    result.iterations
      = iterate(system, *set.preconditioner, parameters.tolerance * norm, parameters, log, x);
    result.description = "conjugate gradients, " + set.name;
    return result;
  }
} // namespace tetradapt::solve
