// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_linear_solver_h
#define tetradapt_solve_linear_solver_h

#include "tetradapt/core/log.h"
#include "tetradapt/mechanics/rigid_coupling.h"
#include "tetradapt/mechanics/stiffness.h"
#include "tetradapt/scene/study_parameters.h"
#include "tetradapt/solve/conjugate_gradients.h"
#include "tetradapt/solve/direct_solver.h"
#include "tetradapt/solve/preconditioners.h"

#include <functional>
#include <optional>

namespace tetradapt::solve
{
  class RigidDirectSolver;

  /** What a matrix and its coarser levels are built from. */
  struct LinearModel
  {
    const fem::Space              &space;
    const mechanics::TangentField &tangents;
    const fem::Constraints        &constraints; ///< of the supports, closed
    /** What these do not have; null: nothing. */
    const mechanics::RigidCouplings *couplings = nullptr;
    const mechanics::Springs        *springs   = nullptr; ///< to be added; null: none
  };

  /** When a solution is good enough. */
  struct LinearStop
  {
    double residual        = 0.; ///< relative to the load; 0: the parameters' tolerance
    double algebraic_error = 0.; ///< energy norm of the error; 0: does not count
    double relative_error  = 0.; ///< the same, relative to what has been gained; 0: does not
    /** The square of the energy norm of @p x with what is prescribed, to which the error is
     * compared where a small residual may hide a large one; not given: (b, x), which it is
     * where all that is prescribed is zero. */
    std::function<double(const Vector &x)> energy;
  };

  struct LinearResult
  {
    unsigned int iterations             = 0;  ///< 0: direct
    unsigned int iterations_to_residual = 0;  ///< see IterationResult
    double       algebraic_error        = 0.; ///< estimated; 0: unknown, or direct
    std::string  description;                 ///< solver and preconditioner, for the log
  };

  /**
   * A stiffness matrix, and what solves systems with it. Chooses by parameters: a
   * factorisation for few unknowns, else conjugate gradients with AMG (degree 1) or with
   * p-multigrid on AMG and a matrix-free product (degree 2). Factors or preconditioner
   * are made once and serve every right-hand side.
   */
  class LinearSolver
  {
  public:
    /** Collective. Keeps references to what @p model refers to, and to the other
     * arguments. */
    LinearSolver(const LinearModel             &model,
                 const scene::SolverParameters &parameters,
                 const core::Log               &log);
    ~LinearSolver();

    /** The right-hand side for forces on the nodes of the field: less those of the
     * prescribed displacement where unknowns are free; elsewhere a diagonal entry of the
     * matrix times the prescribed value. Collective if there are couplings. */
    Vector
    right_hand_side(const Vector &forces) const;

    /**
     * Solves for @p x from @p x on, which has the prescribed values. Conjugate
     * gradients end when the residual is below the tolerance times the norm of the
     * load, which is the right-hand side at free unknowns; or, where an error is given,
     * when that is reached (no residual tells when: that of a slender body's
     * bending is larger than the load for errors of a percent). Collective.
     * @param load is what to call the right-hand side in messages: "The loads".
     * Where the solver is chosen automatically and conjugate gradients do not converge, or
     * are predicted to need more than the allowed iterations, the matrix is factorised after
     * all, up to 150 000 unknowns, and a warning says so.
     * @throws core::NumericalError if it does not converge; IndefiniteMatrix where full tangents
     *         are not positive definite.
     */
    LinearResult
    solve(const Vector      &right_hand_side,
          const LinearStop  &stop,
          const std::string &load,
          Vector            &x) const;

    /** destination = an approximate inverse of the matrix times source, symmetric and
     * positive; the inverse itself if it was factorised. Collective. */
    void
    precondition(Vector &destination, const Vector &source) const;

    /** The matrix with the supports built in. With couplings, for displacements that these
     * allow only. */
    const mechanics::LinearOperator<double> &
    matrix() const;

  private:
    /** Without couplings. */
    const mechanics::LinearOperator<double> &
    nodal_matrix() const;
    /** solve() for what is added to the prescribed motions of couplings. */
    LinearResult
    solve_nodal(const Vector      &right_hand_side,
                const LinearStop  &stop,
                const std::string &load,
                Vector            &x) const;
    void
    factorise(const mechanics::BlockMatrix &matrix) const;
    bool
    is_factorised() const;
    void
    solve_directly(const Vector &right_hand_side, Vector &x) const;
    template <typename Number>
    std::unique_ptr<ApproximateInverse<Number>>
    multigrid(double scale) const;
    void
    precondition_in_single() const;
    void
    precondition_in_double() const;
    /** From now on by polynomials of a higher degree. */
    void
    smooth_more() const;
    double
    largest_diagonal() const;
    /** Null without springs. */
    const mechanics::SpringMatrix<double> *
    spring_matrix() const
    {
      return springs ? &*springs : nullptr;
    }
    double
    load_norm(const Vector &right_hand_side, const std::string &load) const;
    LinearResult
    iterate(const Vector &right_hand_side, const LinearStop &stop, double norm, Vector &x) const;
    IterationResult
    iterate_once(const Vector &right_hand_side, const IterationLimits &limits, Vector &x) const;
    /** The error in the energy norm, relative to the solution, that the residual may hide. */
    double
    hidden_error(const IterationResult &result,
                 const LinearStop      &stop,
                 const Vector          &right_hand_side,
                 const Vector          &x) const;
    [[noreturn]] void
    fail(unsigned int iterations, double excess) const;
    /** Whether there are flat cells, and the preconditioner does not correct for them yet. */
    bool
    has_better_preconditioner() const;
    /** Whether a factorisation may replace conjugate gradients that do not converge. */
    bool
    can_factorise_instead() const;
    void
    factorise_instead(unsigned int iterations) const;

    LinearModel        model;
    const fem::Space  &space;
    fem::FixedUnknowns fixed;
    /** Null where nothing is free to move with a reference point. */
    const mechanics::RigidCouplings                        *couplings;
    const scene::SolverParameters                          &parameters;
    const core::Log                                        &log;
    std::string                                             description;
    std::unique_ptr<mechanics::LinearSystem>                assembled;
    std::unique_ptr<mechanics::MatrixFreeStiffness<double>> matrix_free;
    std::optional<mechanics::SpringMatrix<double>>          springs;
    FlatNodes                                               flat; ///< of degree 2
    std::unique_ptr<mechanics::RigidlyCoupledOperator>      coupled_matrix;
    /** Made again in double precision where single does not do. */
    mutable std::unique_ptr<fem::Space>     coarse_space; ///< of p-multigrid
    mutable std::unique_ptr<Preconditioner> preconditioner;
    mutable bool                            is_single        = false;
    mutable bool                            has_usual_degree = true; ///< of the smoother
    /** From the beginning, or made when conjugate gradients failed. */
    mutable std::unique_ptr<DirectSolver>      direct;
    mutable std::unique_ptr<RigidDirectSolver> rigid_direct; ///< in its place with couplings
  };
} // namespace tetradapt::solve

#endif
