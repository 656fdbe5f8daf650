// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_mixed_solver_h
#define tetradapt_solve_mixed_solver_h

#include "tetradapt/core/log.h"
#include "tetradapt/mechanics/divergence.h"
#include "tetradapt/mechanics/pressure_mass.h"
#include "tetradapt/scene/scene.h"
#include "tetradapt/solve/linear_solver.h"

namespace tetradapt::solve
{
  /**
   * @p scene with each material replaced by one of the same shear modulus and with the gamma of
   * laws::PressureForm as Lame's first constant, in displacement form: its stiffness is what
   * the mixed form has in addition to the pressure, so that assembly, thermal forces and multigrid
   * serve both.
   */
  scene::Scene
  kept_scene(const scene::Scene &scene);

  struct MixedVector;
  struct ResidualDirection;

  /** What the mixed form is made of. */
  struct MixedModel
  {
    std::shared_ptr<const fem::Space>        space; ///< of degree 2
    const mechanics::MaterialMap            &materials;
    const mechanics::PrescribedDisplacement &prescribed;
    const fem::FixedUnknowns                &fixed; ///< prescribed, in local numbers
    const LinearSolver                      &kept;  ///< of kept_scene()
  };

  /**
   * Solves the equations of the mixed form with the elements of Taylor and Hood (see
   * doc/mixed_form.md and laws::PressureForm)
   *
   *   A u + B^T p = f,   A = int 2 mu eps : eps + gamma div div,   B = -int q div u,
   *   B u - C p   = g,   C = int 1/(lambda - gamma) p q,           g = -int q tr eps_thermal,
   *
   * by truncated generalised conjugate residuals (Eisenstat, Elman and Schultz, SIAM J. Numer.
   * Anal. 20, 1983), which minimise (r, D r) with D the inverse of diag(A^, S^): A^ is multigrid
   * for A and S^ the mass matrix of the pressure weighted with 1/(mu + gamma) + 1/(lambda -
   * gamma), spectrally equivalent to the Schur complement C + B A^-1 B^T for every lambda. Their
   * block triangular preconditioner gives the directions. One product with A, B and B^T, one step
   * of A^ and two of S^ an iteration; their number is bounded for all meshes and all lambda.
   */
  class MixedSolver
  {
  public:
    /** Collective. Keeps references to what @p model refers to, and to the other arguments.
     * @throws core::InputError if supports hold all of the boundary of an incompressible part
     *         and change its volume. */
    MixedSolver(const MixedModel              &model,
                const scene::SolverParameters &parameters,
                const core::Log               &log);

    const std::shared_ptr<const fem::PressureSpace> &
    space() const
    {
      return pressures;
    }

    /**
     * Solves from @p u, which has the prescribed values, and from @p pressure, of space(), on. Ends
     * when the residual is below the tolerance times that of the load, or below @p
     * stop.algebraic_error: both in the norm of the inverse of diag(A^, S^), which is equivalent to
     * the energy norm of the error. A pressure that is determined up to a constant only gets the
     * mean zero. Collective.
     * @param forces the right-hand side of the displacements, see LinearSolver.
     * @throws core::NumericalError if it does not converge.
     */
    LinearResult
    solve(const Vector &forces, const LinearStop &stop, Vector &u, Vector &pressure) const;

  private:
    struct Iterate;
    /** Sets the residuals of an iterate, what the preconditioner makes of them, and the norm. */
    void
    set_residuals(const Vector &forces, Iterate &state) const;
    /** The block triangular preconditioner's direction, from diag(A^, S^)^-1 times the residual,
     * with its forces. */
    void
    make_direction(const MixedVector &preconditioned_residual, ResidualDirection &result) const;
    /** Iterates until the norm is at most @p target, at most as often as the parameters allow. */
    void
    iterate(const Vector &forces, double target, Iterate &state) const;
    /** Finds the pressures that move nothing, one for each incompressible part whose boundary
     * is held, and makes the equations solvable. */
    void
    find_free_pressures();
    /** Refuses supports that change the volume, and spreads what their interpolation does. */
    void
    check_volume(const Vector &free_pressure);

    MixedModel                                model;
    const scene::SolverParameters            &parameters;
    const core::Log                          &log;
    std::shared_ptr<const fem::PressureSpace> pressures;
    mechanics::Divergence                     divergence;
    mechanics::PressureMass                   mass;
    Vector                                    volume_load; ///< g
    std::vector<Vector>                       free_pressures;
  };
} // namespace tetradapt::solve

#endif
