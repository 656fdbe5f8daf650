// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/mixed_solver.h"
#include "tetradapt/laws/law_catalogue.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/laws/constitutive_law.h"

#include "residual_directions.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::solve
{
  scene::Scene
  kept_scene(const scene::Scene &scene)
  {
    scene::Scene result = scene;
    result.formulation  = scene::Formulation::displacement;
    for (auto &material : result.materials)
      {
        const auto law    = laws::make_law(material.law, material.constants);
        const auto linear = dynamic_cast<const laws::LinearLaw *>(law.get());
        const auto form   = linear != nullptr ? linear->pressure_form() : std::nullopt;
        if (!form)
          continue;
        const double mu    = form->shear_modulus;
        const double nu    = 0.5 * form->kept_lambda / (form->kept_lambda + mu);
        material.law       = "linear elastic";
        material.constants = {{"Young modulus", 2. * mu * (1. + nu)}, {"Poisson ratio", nu}};
      }
    return result;
  }

  namespace
  {
    /** How much larger than the norm of the residual the energy norm of the error may be: the
     * root of the inverse of the smallest eigenvalue of multigrid, and of the Schur complement
     * with the weighted mass matrix. */
    constexpr double error_factor = 3.;

    /** By how much the residual may fall before it and what the preconditioner makes of it are
     * computed again: steps go on with those of single precision, whose errors add up. */
    constexpr double first_drift = 1e-3;
  } // namespace

  /** An iterate with its residuals, and the state of the iteration. */
  struct MixedSolver::Iterate
  {
    MixedVector  x, residual, preconditioned; ///< the latter diag(A^, S^)^-1 times the residual
    double       norm       = 0.;             ///< root of their product
    unsigned int iterations = 0;
    bool         converged  = false;
  };

  MixedSolver::MixedSolver(const MixedModel              &model,
                           const scene::SolverParameters &parameters,
                           const core::Log               &log)
    : model(model), parameters(parameters), log(log),
      pressures(std::make_shared<const fem::PressureSpace>(
        model.space, std::make_shared<const mesh::PressureNodes>(model.space->tet_mesh()))),
      divergence(*pressures, model.fixed), mass(*pressures, model.materials),
      volume_load(mechanics::thermal_volume_load(*pressures, model.materials))
  {
    find_free_pressures();
  }

  void
  MixedSolver::set_residuals(const Vector &forces, Iterate &state) const
  {
    MixedVector &r = state.residual, &z = state.preconditioned;
    model.kept.matrix().vmult(r.u, state.x.u);
    divergence.add_transposed(r.u, state.x.p);
    r.u.sadd(-1., 1., forces);
    divergence.vmult(r.p, state.x.u);
    mass.vmult_compliance(z.p, state.x.p);
    r.p -= z.p;
    r.p.sadd(-1., 1., volume_load);
    model.kept.precondition(z.u, r.u);
    mass.precondition(z.p, r.p);
    // A sum that is negative, from a cycle that is not positive, becomes NaN, as one of NaN is.
    state.norm = std::sqrt(r.u * z.u + r.p * z.p);
  }

  void
  MixedSolver::make_direction(const MixedVector &preconditioned_residual,
                              ResidualDirection &result) const
  {
    MixedVector &d = result.direction, &q = result.force, &v = result.preconditioned_force;
    d.u = preconditioned_residual.u;
    divergence.vmult(q.p, d.u);
    mass.precondition(d.p, q.p);
    d.p -= preconditioned_residual.p;
    mass.vmult_compliance(v.p, d.p);
    q.p -= v.p;
    model.kept.matrix().vmult(q.u, d.u);
    divergence.add_transposed(q.u, d.p);
    model.kept.precondition(v.u, q.u);
    mass.precondition(v.p, q.p);
  }

  void
  MixedSolver::iterate(const Vector &forces, const double target, Iterate &state) const
  {
    ResidualDirections directions;
    double             drift = first_drift, fresh = state.norm;
    const auto         refresh = [&] {
      const double expected = state.norm;
      set_residuals(forces, state);
      fresh = state.norm;
      if (state.norm > 1.2 * expected)
        drift = std::max(drift, 0.1);
    };
    while (true)
      {
        if (state.norm < drift * fresh || !std::isfinite(state.norm))
          refresh();
        std::ostringstream text;
        text << "mixed form, iteration " << state.iterations << ", residual over tolerance "
             << state.norm / target;
        log.progress(text.str());
        state.converged = state.norm <= target;
        if (state.converged || state.iterations >= parameters.max_iterations
            || !std::isfinite(state.norm))
          return;

        ResidualDirection &d = directions.next(state.x);
        make_direction(state.preconditioned, d);
        directions.orthogonalise();
        if (!(d.square > 0.))
          {
            // Rounding: of no use if the residual is what it seems.
            if (state.norm == fresh)
              return;
            refresh();
            directions.clear();
            continue;
          }
        MixedVector &r = state.residual, &z = state.preconditioned;
        const double step
          = (r.u * d.preconditioned_force.u + r.p * d.preconditioned_force.p) / d.square;
        for (Vector MixedVector::*part : {&MixedVector::u, &MixedVector::p})
          {
            (state.x.*part).add(step, d.direction.*part);
            (r.*part).add(-step, d.force.*part);
            (z.*part).add(-step, d.preconditioned_force.*part);
          }
        const double square = r.u * z.u + r.p * z.p;
        // Rounding alone may make it negative here, where only differences are added up.
        state.norm = square < 0. ? 0. : std::sqrt(square);
        ++state.iterations;
      }
  }

  LinearResult
  MixedSolver::solve(const Vector     &forces,
                     const LinearStop &stop,
                     Vector           &u,
                     Vector           &pressure) const
  {
    Iterate state{{u, volume_load}, {forces, volume_load}, {forces, volume_load}};
    // The load is the residual where nothing moves but what is prescribed.
    state.x.p = 0.;
    state.x.u = 0.;
    model.fixed.distribute(state.x.u);
    set_residuals(forces, state);
    const double norm = state.norm;
    if (!std::isfinite(norm))
      throw core::NumericalError("The loads are not finite. Look at their values and at the "
                                 "material constants.");
    if (norm == 0. && !(state.residual.u.all_zero() && state.residual.p.all_zero()))
      throw core::NumericalError("The loads are so small that their squares leave the range of "
                                 "double precision. Choose other units.");
    if (norm == 0.)
      {
        u        = state.x.u;
        pressure = 0.;
        return {0, 0, 0., "nothing to solve: no load"};
      }
    state.x.p = pressure;
    Vector difference(u);
    difference -= state.x.u;
    if (!difference.all_zero() || !state.x.p.all_zero())
      {
        state.x.u = u;
        set_residuals(forces, state);
      }
    const double tolerance = stop.residual > 0. ? stop.residual : parameters.tolerance;
    const double target    = std::max(tolerance * norm, stop.algebraic_error / error_factor);
    iterate(forces, target, state);
    if (!state.converged)
      {
        std::ostringstream message;
        message << "The iteration of the mixed form did not converge: after " << state.iterations
                << " iterations the residual is " << state.norm / target
                << " times the allowed one. Look for materials of very different stiffness or very "
                   "flat elements, or raise Solver/Maximum iterations.";
        throw core::NumericalError(message.str());
      }
    Vector product(state.x.p);
    for (const Vector &constant : free_pressures)
      {
        mass.vmult(product, constant);
        state.x.p.add(-(product * state.x.p) / (product * constant), constant);
      }
    u        = state.x.u;
    pressure = state.x.p;
    return {state.iterations,
            state.iterations,
            error_factor * state.norm,
            "mixed form, p-multigrid on AMG"};
  }
} // namespace tetradapt::solve
