// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/linear_solver.h"

#include "tetradapt/core/exceptions.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <sstream>

namespace tetradapt::solve
{
  namespace
  {
    bool
    is_direct(const scene::SolverParameters &parameters, unsigned long n_dofs)
    {
      using Type = scene::SolverParameters::Type;
      return parameters.type == Type::direct
             || (parameters.type == Type::automatic && n_dofs <= parameters.direct_limit);
    }
  } // namespace

  LinearSolver::LinearSolver(const LinearModel             &model,
                             const scene::SolverParameters &parameters,
                             const core::Log               &log)
    : space(model.space), prescribed(model.prescribed), parameters(parameters), log(log)
  {
    const bool factorise = is_direct(parameters, space.n_dofs());
    if (factorise || space.degree() == 1)
      assembled = std::make_unique<mechanics::LinearSystem>(
        mechanics::assemble(space, model.tangents, prescribed));
    else
      matrix_free = std::make_unique<mechanics::MatrixFreeStiffness<double>>(space,
                                                                             model.tangents,
                                                                             prescribed);
    log.progress(factorise ? "factorising" : "building the preconditioner");
    if (factorise)
      {
        direct      = std::make_unique<DirectSolver>(assembled->matrix, space);
        description = "direct (KLU)";
      }
    else
      make_preconditioner(model);
  }
  void
  LinearSolver::make_preconditioner(const LinearModel &model)
  {
    if (space.degree() == 1)
      {
        preconditioner = make_amg(assembled->matrix, space, prescribed);
        description    = "conjugate gradients, AMG";
        return;
      }
    coarse_space      = std::make_unique<mechanics::DisplacementSpace>(model.partition, 1, nullptr);
    const auto coarse = mechanics::assemble(*coarse_space, model.tangents, prescribed);
    preconditioner    = make_p_multigrid<double>(
      std::make_unique<mechanics::MatrixFreeStiffness<double>>(space, model.tangents, prescribed),
      space,
      *coarse_space,
      prescribed,
      make_amg(coarse.matrix, *coarse_space, prescribed));
    description = "conjugate gradients, p-multigrid on AMG";
  }

  const mechanics::LinearOperator<double> &
  LinearSolver::matrix() const
  {
    if (matrix_free != nullptr)
      return *matrix_free;
    return assembled->matrix;
  }

  Vector
  LinearSolver::right_hand_side(const std::vector<dealii::Tensor<1, 3>> &forces) const
  {
    return matrix_free != nullptr
             ? matrix_free->right_hand_side(prescribed, forces)
             : mechanics::right_hand_side(*assembled, space, prescribed, forces);
  }

  double
  LinearSolver::load_norm(const Vector &right_hand_side) const
  {
    // What is left of the residual when only the prescribed displacements are applied.
    double sum = 0.;
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        if (!prescribed.is_fixed(space.field_node(node), c))
          sum += std::pow(right_hand_side.local_element(3 * node + c), 2);
    return std::sqrt(dealii::Utilities::MPI::sum(sum, space.communicator()));
  }

  LinearResult
  LinearSolver::solve(const Vector      &right_hand_side,
                      const LinearStop  &stop,
                      const std::string &load,
                      Vector            &x) const
  {
    if (direct != nullptr)
      {
        direct->solve(right_hand_side, x);
        return {0, 0, 0., description};
      }
    const double norm = load_norm(right_hand_side);
    if (!std::isfinite(norm))
      throw core::NumericalError(load
                                 + " are not finite. Look at their values and at the material "
                                   "constants.");
    if (norm > 0.)
      return iterate(right_hand_side, stop, norm, x);
    // Nothing moves but what is prescribed, and that moves nothing else.
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        if (!prescribed.is_fixed(space.field_node(node), c))
          x.local_element(3 * node + c) = 0.;
    return {0, 0, 0., "nothing to solve: no load"};
  }

  LinearResult
  LinearSolver::iterate(const Vector     &right_hand_side,
                        const LinearStop &stop,
                        double            norm,
                        Vector           &x) const
  {
    IterationLimits limits;
    limits.residual       = (stop.residual > 0. ? stop.residual : parameters.tolerance) * norm;
    limits.error          = stop.algebraic_error;
    limits.relative_error = stop.relative_error;
    limits.max_iterations = parameters.max_iterations;
    const IterationResult result
      = conjugate_gradients(matrix(), *preconditioner, right_hand_side, limits, log, x);
    if (!result.converged)
      {
        std::ostringstream message;
        message << "Conjugate gradients did not converge: after " << result.iterations
                << " iterations the residual is " << result.residual / limits.residual
                << " times the allowed one. Look for materials of very different stiffness, a "
                   "Poisson ratio close to 0.5 or very flat elements; or raise Solver/Maximum "
                   "iterations, or set Solver/Type = direct.";
        throw core::NumericalError(message.str());
      }
    return {result.iterations, result.iterations_to_residual, result.error, description};
  }

  void
  LinearSolver::precondition(Vector &destination, const Vector &source) const
  {
    if (direct != nullptr)
      direct->solve(source, destination);
    else
      preconditioner->vmult(destination, source);
  }
} // namespace tetradapt::solve
