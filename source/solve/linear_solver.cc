// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/linear_solver.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/solve/indefinite_matrix.h"

#include "flat_correction.h"
#include "rigid_solvers.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <type_traits>

namespace tetradapt::solve
{
  namespace
  {
    /** Largest relative error in the energy norm by the tolerance of the residual. */
    constexpr double error_by_residual = 10.;

    /** Of the norm of loads: products with residuals 1e-16 times as large still count. */
    constexpr double smallest_square = 1e-250;

    /** Least energy of a solution by that of what was added to the first iterate. */
    constexpr double least_energy = 1e-12;

    /** The iterations from which a prediction of the remaining ones counts: for the correction
     * for flat cells, and for a factorisation. So early it may be wrong, as where bending is
     * found late: that costs time, but no solution. */
    constexpr unsigned int correction_from = 20, factorisation_from = 40;

    /** Predicted iterations above which flat cells are worth more work: first a higher degree of
     * the smoother, then the correction for them, whose set-up takes long. */
    constexpr unsigned int most_if_flat = 60;

    /** The degree of the smoother that pays where degree 1 corrects badly, as in flat cells; but
     * not together with the correction for these. */
    constexpr unsigned int higher_degree = 12;

    /** The largest number of unknowns for which a factorisation takes over. */
    constexpr unsigned long most_factorised_later = 150000;

    /** One cycle of algebraic multigrid for a matrix of degree 1 times @p scale. */
    template <typename Number>
    std::unique_ptr<ApproximateInverse<Number>>
    coarse_solver(const scene::SolverParameters   &parameters,
                  const mechanics::BlockMatrix    &matrix,
                  const fem::Space                &space,
                  const fem::FixedUnknowns        &fixed,
                  const double                     scale,
                  const mechanics::RigidCouplings *couplings)
    {
      if constexpr (std::is_same_v<Number, double>)
        if (parameters.multigrid == scene::SolverParameters::Multigrid::trilinos)
          return make_trilinos_amg(matrix, space, fixed);
      return make_amg<Number>(matrix, space, fixed, scale, couplings);
    }

    dealii::Tensor<1, 3>
    at_node(const Vector &x, const unsigned int node)
    {
      dealii::Tensor<1, 3> value;
      for (unsigned int c = 0; c < 3; ++c)
        value[c] = x.local_element(3 * node + c);
      return value;
    }

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
    : model(model), space(model.space), fixed(model.space, model.constraints),
      couplings(model.couplings != nullptr && !model.couplings->empty() ? model.couplings
                                                                        : nullptr),
      parameters(parameters), log(log)
  {
    if (model.springs != nullptr && !model.springs->empty())
      springs.emplace(mechanics::make_spring_matrix(*model.springs, space));
    const bool is_small = is_direct(parameters, space.n_dofs());
    if (is_small || space.degree() == 1)
      assembled = std::make_unique<mechanics::LinearSystem>(
        mechanics::assemble(space, model.tangents, fixed, spring_matrix()));
    else
      matrix_free = std::make_unique<mechanics::MatrixFreeStiffness<double>>(
        space, model.tangents, fixed, 1., spring_matrix());
    if (couplings != nullptr)
      coupled_matrix
        = std::make_unique<mechanics::RigidlyCoupledOperator>(nodal_matrix(), *couplings);
    log.progress(is_small ? "factorising" : "building the preconditioner");
    if (is_small)
      {
        factorise(assembled->matrix);
        description = "direct (Cholesky)";
      }
    else
      {
        if (space.degree() == 2)
          flat = find_flat_nodes(space);
        // What is coupled is left to the coarse levels.
        if (couplings != nullptr && flat.exist)
          for (const auto &node : couplings->nodes())
            if (node.local < flat.reach.size())
              flat.reach[node.local] = 0.;
        const bool ml = parameters.multigrid == scene::SolverParameters::Multigrid::trilinos;
        // Where cells are very flat, the plain cycle would be given up in any case.
        if (ml || flat.are_very_flat)
          precondition_in_double();
        else
          precondition_in_single();
        description = std::string("conjugate gradients, ")
                      + (space.degree() == 1 ? "" : "p-multigrid on ")
                      + (ml ? "Trilinos' AMG" : "AMG");
      }
  }

  LinearSolver::~LinearSolver() = default;

  void
  LinearSolver::factorise(const mechanics::BlockMatrix &matrix) const
  {
    if (couplings != nullptr)
      rigid_direct = std::make_unique<RigidDirectSolver>(matrix, space, *couplings);
    else
      direct = std::make_unique<DirectSolver>(matrix, space, model.tangents.is_full());
  }

  bool
  LinearSolver::is_factorised() const
  {
    return direct != nullptr || rigid_direct != nullptr;
  }

  void
  LinearSolver::solve_directly(const Vector &right_hand_side, Vector &x) const
  {
    if (rigid_direct != nullptr)
      rigid_direct->solve(right_hand_side, x);
    else
      direct->solve(right_hand_side, x);
  }

  double
  LinearSolver::largest_diagonal() const
  {
    double largest = 0.;
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const double entry
            = matrix_free != nullptr
                ? matrix_free->diagonal_blocks()[node][4 * c]
                : assembled->matrix.block(assembled->matrix.row_begin(node))[4 * c];
          largest = std::max(largest, entry);
        }
    return dealii::Utilities::MPI::max(largest, space.communicator());
  }

  template <typename Number>
  std::unique_ptr<ApproximateInverse<Number>>
  LinearSolver::multigrid(double scale) const
  {
    if (space.degree() == 1)
      return coarse_solver<Number>(parameters, assembled->matrix, space, fixed, scale, couplings);
    coarse_space = fem::Space::linear_part(space);
    const fem::FixedUnknowns coarse_fixed(
      *coarse_space, fem::restrict_to(*coarse_space, space, model.constraints));
    std::optional<mechanics::SpringMatrix<double>> coarse_springs;
    if (springs)
      coarse_springs.emplace(mechanics::make_spring_matrix(*model.springs, *coarse_space));
    const auto                                       coarse = mechanics::assemble(*coarse_space,
                                            model.tangents,
                                            coarse_fixed,
                                            coarse_springs ? &*coarse_springs : nullptr);
    std::vector<mechanics::RigidCoupling>            at_vertices;
    std::unique_ptr<const mechanics::RigidCouplings> coarse_couplings;
    if (couplings != nullptr)
      {
        at_vertices      = restrict_to_vertices(couplings->all(), space.tet_mesh().n_points());
        coarse_couplings = std::make_unique<mechanics::RigidCouplings>(at_vertices, *coarse_space);
      }
    std::unique_ptr<FlatCorrection<Number>> flat_correction;
    // Bending of flat cells is lost in the rounding of single precision.
    if (flat.exist && std::is_same_v<Number, double>)
      flat_correction = std::make_unique<FlatCorrection<Number>>(
        mechanics::assemble(space, model.tangents, fixed, spring_matrix()).matrix.rows(),
        space,
        fixed,
        flat,
        scale);
    return make_p_multigrid<Number>(
      std::make_unique<mechanics::MatrixFreeStiffness<Number>>(
        space, model.tangents, fixed, scale, spring_matrix()),
      space,
      *coarse_space,
      fixed,
      coarse_solver<Number>(
        parameters, coarse.matrix, *coarse_space, coarse_fixed, scale, coarse_couplings.get()),
      std::move(flat_correction),
      couplings);
  }

  void
  LinearSolver::precondition_in_single() const
  {
    // Entries near one stay in the range of single precision whatever the units.
    const double scale = 1. / largest_diagonal();
    preconditioner     = in_double(multigrid<float>(scale), scale, space.vector_layout());
    if (couplings != nullptr)
      preconditioner = std::make_unique<RigidPreconditioner>(std::move(preconditioner), *couplings);
    is_single        = true;
    has_usual_degree = true;
    if (flat.are_dominant)
      smooth_more();
  }

  void
  LinearSolver::smooth_more() const
  {
    preconditioner->set_smoother_degree(higher_degree);
    has_usual_degree = false;
  }

  void
  LinearSolver::precondition_in_double() const
  {
    preconditioner.reset();
    preconditioner = multigrid<double>(1.);
    if (couplings != nullptr)
      preconditioner = std::make_unique<RigidPreconditioner>(std::move(preconditioner), *couplings);
    is_single = false;
  }

  const mechanics::LinearOperator<double> &
  LinearSolver::matrix() const
  {
    if (coupled_matrix != nullptr)
      return *coupled_matrix;
    return nodal_matrix();
  }

  const mechanics::LinearOperator<double> &
  LinearSolver::nodal_matrix() const
  {
    if (matrix_free != nullptr)
      return *matrix_free;
    return assembled->matrix;
  }

  Vector
  LinearSolver::right_hand_side(const Vector &forces) const
  {
    Vector b = matrix_free != nullptr
                 ? matrix_free->right_hand_side(forces)
                 : mechanics::right_hand_side(*assembled, space, fixed, forces);
    if (couplings == nullptr)
      return b;
    if (!couplings->is_homogeneous())
      {
        Vector prescribed(space.vector_layout()), force(space.vector_layout());
        couplings->add_prescribed(1., prescribed);
        Vector free(prescribed);
        couplings->project(free);
        prescribed -= free; // as in solve()
        nodal_matrix().vmult(force, prescribed);
        b -= force;
      }
    couplings->project(b);
    return b;
  }

  double
  LinearSolver::load_norm(const Vector &right_hand_side, const std::string &load) const
  {
    // What is left of the residual when only the prescribed displacements are applied.
    double sum = 0., largest = 0.;
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      {
        const auto force = fixed.free_part(node, at_node(right_hand_side, node));
        for (unsigned int c = 0; c < 3; ++c)
          {
            sum += force[c] * force[c];
            largest = std::max(largest, std::abs(force[c]));
          }
      }
    sum     = dealii::Utilities::MPI::sum(sum, space.communicator());
    largest = dealii::Utilities::MPI::max(largest, space.communicator());
    // Squares of tiny loads vanish, and nothing would move.
    if (sum < smallest_square && largest > 0.)
      throw core::NumericalError(load
                                 + " are so small that their squares leave the range of double "
                                   "precision. Choose other units.");
    return std::sqrt(sum);
  }

  LinearResult
  LinearSolver::solve(const Vector      &right_hand_side,
                      const LinearStop  &stop,
                      const std::string &load,
                      Vector            &x) const
  {
    if (couplings == nullptr)
      return solve_nodal(right_hand_side, stop, load, x);
    // What is prescribed of the motions stays as it is, but for what the free ones can be.
    Vector prescribed(x);
    couplings->project(x);
    prescribed -= x;
    LinearStop stop_of_rest = stop;
    if (stop.energy)
      stop_of_rest.energy = [&](const Vector &rest) {
        Vector whole(rest);
        whole += prescribed;
        return stop.energy(whole);
      };
    const LinearResult result = solve_nodal(right_hand_side, stop_of_rest, load, x);
    x += prescribed;
    return result;
  }

  LinearResult
  LinearSolver::solve_nodal(const Vector      &right_hand_side,
                            const LinearStop  &stop,
                            const std::string &load,
                            Vector            &x) const
  {
    const double norm = load_norm(right_hand_side, load);
    if (!std::isfinite(norm))
      throw core::NumericalError(load
                                 + " are not finite. Look at their values and at the material "
                                   "constants.");
    if (is_factorised())
      {
        solve_directly(right_hand_side, x);
        return {0, 0, 0., description};
      }
    if (norm > 0.)
      return iterate(right_hand_side, stop, norm, x);
    // Nothing moves but what is fixed, and that moves nothing else.
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      {
        const auto u = at_node(x, node), held = u - fixed.free_part(node, u);
        for (unsigned int c = 0; c < 3; ++c)
          x.local_element(3 * node + c) = held[c];
      }
    return {0, 0, 0., "nothing to solve: no load"};
  }

  double
  LinearSolver::hidden_error(const IterationResult &result,
                             const LinearStop      &stop,
                             const Vector          &right_hand_side,
                             const Vector          &x) const
  {
    if (result.preconditioned_residual == 0.)
      return 0.;
    const double energy = stop.energy ? stop.energy(x) : right_hand_side * x;
    // A body that moves as a whole has no energy but that of rounding.
    const double square = std::max(energy, 0.) + least_energy * result.gained;
    return std::isfinite(energy + square) ? result.preconditioned_residual / std::sqrt(square)
                                          : std::numeric_limits<double>::quiet_NaN();
  }

  LinearResult
  LinearSolver::iterate(const Vector     &right_hand_side,
                        const LinearStop &stop,
                        double            norm,
                        Vector           &x) const
  {
    const double    tolerance = stop.residual > 0. ? stop.residual : parameters.tolerance;
    IterationLimits limits;
    limits.residual       = tolerance * norm;
    limits.error          = stop.algebraic_error;
    limits.relative_error = stop.relative_error;
    LinearResult result{0, 0, 0., description};
    double       gained = 0.;
    // The residual's norm is ruled by stiff and by flat elements. So it may be small
    // compared with that of the load while soft parts are still wrong: then it has to become
    // smaller.
    for (double excess = 2.; excess > 1.;)
      {
        limits.max_iterations  = parameters.max_iterations - result.iterations; // in total
        const bool may_improve = has_better_preconditioner();
        limits.most_predicted  = may_improve ? most_if_flat : limits.max_iterations;
        limits.give_up_from    = may_improve               ? correction_from
                                 : can_factorise_instead() ? factorisation_from
                                                           : 0;
        IterationResult step   = iterate_once(right_hand_side, limits, x);
        result.iterations += step.iterations;
        result.iterations_to_residual
          = result.iterations + step.iterations_to_residual - step.iterations;
        result.algebraic_error = step.error;
        // Of laws that are not linear this tells of the body; of others, of rounding.
        if (model.tangents.is_full() && step.is_indefinite)
          throw IndefiniteMatrix();
        if (step.gave_up && may_improve && has_usual_degree)
          {
            smooth_more();
            gained += step.gained;
            continue;
          }
        // Elements with almost no volume can be too much for single precision.
        if (!step.converged && is_single && result.iterations < parameters.max_iterations)
          {
            log.progress("building the preconditioner in double precision");
            precondition_in_double();
            gained += step.gained;
            continue;
          }
        if (!step.converged && can_factorise_instead())
          {
            factorise_instead(result.iterations);
            solve_directly(right_hand_side, x);
            return {0, 0, 0., "direct (Cholesky), since conjugate gradients did not converge"};
          }
        if (!step.converged)
          fail(result.iterations, step.residual / limits.residual);
        if (step.residual > limits.residual)
          break; // ended by its error
        gained += step.gained;
        step.gained = gained;
        excess = hidden_error(step, stop, right_hand_side, x) / (error_by_residual * tolerance);
        if (!std::isfinite(excess))
          throw core::NumericalError(
            "The energy of the solution is not finite: it leaves the range "
            "of double precision. Choose other units.");
        limits.residual = std::min(limits.residual, step.residual) / std::max(2., 2. * excess);
      }
    return result;
  }

  IterationResult
  LinearSolver::iterate_once(const Vector          &right_hand_side,
                             const IterationLimits &limits,
                             Vector                &x) const
  {
    EnergyControl control(limits, [this](const unsigned int step, const double relative) {
      std::ostringstream text;
      text << "conjugate gradients, iteration " << step << ", residual over tolerance " << relative;
      log.progress(text.str());
    });
    const Ending  ending
      = conjugate_gradients(matrix(), *preconditioner, right_hand_side, control, x);
    IterationResult result = control.result();
    result.converged       = ending == Ending::converged;
    // In double precision only the matrix makes multigrid not positive; a factorisation would tell.
    result.is_indefinite
      = ending == Ending::indefinite
        || (ending == Ending::not_positive && !is_single && !can_factorise_instead());
    if (ending == Ending::not_finite)
      result.gained = 0.; // x is what it was
    if (result.iterations == 0 && result.residual > 0.)
      {
        // No step has told what the residual means for the error.
        Vector residual(right_hand_side), preconditioned(right_hand_side);
        matrix().vmult(residual, x);
        residual.sadd(-1., 1., right_hand_side);
        preconditioner->vmult(preconditioned, residual);
        result.preconditioned_residual = std::sqrt(std::max(0., residual * preconditioned));
      }
    return result;
  }

  bool
  LinearSolver::has_better_preconditioner() const
  {
    return flat.exist && is_single;
  }

  bool
  LinearSolver::can_factorise_instead() const
  {
    return parameters.type == scene::SolverParameters::Type::automatic
           && space.n_dofs() <= most_factorised_later;
  }

  void
  LinearSolver::factorise_instead(const unsigned int iterations) const
  {
    const std::string given_up
      = "Conjugate gradients were given up after " + std::to_string(iterations) + " iterations";
    // Tangents may be hard to solve with only on the way to a solution.
    if (model.tangents.is_full())
      log.detail(given_up + ". The direct solver takes over.");
    else
      log.warning(given_up
                  + ", since they converge too slowly: elements are very flat or long, "
                    "or materials differ very much in stiffness. The direct solver takes over.");
    log.progress("factorising");
    factorise(assembled != nullptr
                ? assembled->matrix
                : mechanics::assemble(space, model.tangents, fixed, spring_matrix()).matrix);
    preconditioner.reset();
  }

  void
  LinearSolver::fail(const unsigned int iterations, const double excess) const
  {
    std::ostringstream message;
    message << "Conjugate gradients did not converge: after " << iterations
            << " iterations the residual is " << excess
            << " times the allowed one. Look for materials of very different stiffness, a "
               "Poisson ratio close to 0.5 or very flat elements; or raise Solver/Maximum "
               "iterations, or set Solver/Type = direct.";
    throw core::NumericalError(message.str());
  }

  void
  LinearSolver::precondition(Vector &destination, const Vector &source) const
  {
    if (is_factorised())
      solve_directly(source, destination);
    else
      preconditioner->vmult(destination, source);
  }
} // namespace tetradapt::solve
