// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_nonlinear_solver_h
#define tetradapt_solve_nonlinear_solver_h

#include "tetradapt/core/log.h"
#include "tetradapt/mechanics/nonlinear_stiffness.h"
#include "tetradapt/mechanics/supports.h"
#include "tetradapt/scene/study_parameters.h"
#include "tetradapt/solve/newton.h"

namespace tetradapt::solve
{
  /** What is solved for. */
  struct NonlinearModel
  {
    const fem::Space                        &space;
    const mechanics::MaterialMap            &materials;
    const mechanics::PrescribedDisplacement &prescribed;
    const Vector                            &forces; ///< of the loads; they keep their directions
  };

  struct NonlinearResult
  {
    unsigned int steps             = 0; ///< of Newton's method, in all load steps
    unsigned int load_steps        = 0;
    unsigned int vain_steps        = 0; ///< of Newton's method, in load steps that were given up
    unsigned int linear_iterations = 0;
    /** Relative residuals of the last load step. */
    std::vector<double> residuals;
    double              stored_energy = 0.;
    /** Estimated error in the norm of the tangent: the root of r . dx of the last step, times what
     * that step made of the residual. */
    double algebraic_error = 0.;
  };

  /**
   * Static equilibrium of a body whose laws are not linear: Newton's method at the full load,
   * from where it is started; where that does not converge, the load and what supports prescribe
   * are raised in steps that follow how well Newton's method does.
   */
  class NonlinearSolver
  {
  public:
    /** Keeps references. */
    NonlinearSolver(const NonlinearModel          &model,
                    const scene::SolverParameters &parameters,
                    const core::Log               &log);

    /**
     * @param x the first iterate; what supports prescribe need not be there. The solution
     * afterwards. Collective.
     * @throws core::NumericalError naming the part of the load that was reached, and why it
     *         went no further.
     */
    NonlinearResult
    solve(Vector &x);

    /** int P : grad N at @p x. Collective. */
    Vector
    internal_forces(const Vector &x) const;

  private:
    /** One run of Newton's method at the part @p factor of the load. */
    Newton::Result
    equilibrate(double factor, Vector &x);
    Newton::State
    residual(double factor, const Vector &x, Vector &r) const;
    unsigned int
    solve_step(double factor, const Vector &x, const Vector &r, double tolerance, Vector &step);
    /** Whether the tangent at @p x is positive definite: by a factorisation, or as far as conjugate
     * gradients for forces without symmetry see it. */
    bool
    is_stable(const Vector &x);
    bool
    moves_prescribed(double factor, const Vector &x) const;
    std::string
    why(const Newton::Result &result) const;

    NonlinearModel                 model;
    const scene::SolverParameters &parameters;
    const core::Log               &log;
    mechanics::NonlinearStiffness  stiffness;
    mutable mechanics::Deformed    deformed;                            ///< of the last residual
    double                         last_error = 0., last_residual = 0.; ///< before the last step
    std::unique_ptr<mechanics::TangentField> tangents;
  };
} // namespace tetradapt::solve

#endif
