// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/mixed_solver.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::solve
{
  scene::Scene
  shear_scene(const scene::Scene &scene)
  {
    scene::Scene result = scene;
    result.formulation  = scene::Formulation::displacement;
    for (auto &material : result.materials)
      {
        material.young_modulus /= 1. + material.poisson_ratio; // 2 mu
        material.poisson_ratio = 0.;
      }
    return result;
  }

  namespace
  {
    /** How much larger than the norm of the residual the energy norm of the error may be: the
     * root of the inverse of the smallest eigenvalue of multigrid, and of the Schur complement
     * with the weighted mass matrix. */
    constexpr double error_factor = 3.;
  } // namespace

  /** An iterate with its residuals, and the state of the iteration. */
  struct MixedSolver::Iterate
  {
    Vector u, p;
    Vector r1, r2; ///< residuals
    /** Of A^. The multigrid's smallest eigenvalue is seldom less. */
    double       scale      = 0.5;
    unsigned int iterations = 0;
    double       norm       = 0.; ///< of the residuals
    bool         converged  = false;
  };

  MixedSolver::MixedSolver(const MixedModel              &model,
                           const scene::SolverParameters &parameters,
                           const core::Log               &log)
    : model(model), parameters(parameters), log(log),
      pressures(model.space, std::make_shared<const mesh::PressureNodes>(model.space.tet_mesh())),
      divergence(pressures, model.prescribed), mass(pressures, model.materials),
      volume_load(mechanics::thermal_volume_load(pressures, model.materials))
  {
    find_free_pressures();
  }

  void
  MixedSolver::set_residuals(const Vector &forces, Iterate &x) const
  {
    model.shear.matrix().vmult(x.r1, x.u);
    divergence.add_transposed(x.r1, x.p);
    x.r1.sadd(-1., 1., forces);
    Vector product(x.r2);
    divergence.vmult(x.r2, x.u);
    mass.vmult_compliance(product, x.p);
    x.r2 -= product;
    x.r2.sadd(-1., 1., volume_load);
  }

  double
  MixedSolver::load_norm(const Vector &forces) const
  {
    Iterate x{forces, volume_load, forces, volume_load};
    x.p = 0.;
    for (unsigned int node = 0; node < model.space.n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        x.u.local_element(3 * node + c) = model.prescribed.values[model.space.field_node(node)][c];
    set_residuals(forces, x);
    model.shear.precondition(x.u, x.r1);
    mass.precondition(x.p, x.r2);
    return std::sqrt(x.u * x.r1 + x.p * x.r2);
  }

  void
  MixedSolver::iterate(const Vector &forces, const double target, Iterate &x) const
  {
    set_residuals(forces, x);
    // z = P^-1 r with P the triangular preconditioner, d the direction, q = M d.
    Vector     z1(x.u), Az(x.u), d1(x.u), Ad(x.u), q1(x.u), v1(x.u);
    Vector     z2(x.p), Bz(x.p), d2(x.p), Bd(x.p), q2(x.p), w(x.p);
    const auto precondition = [&](Vector &destination, const Vector &source) {
      model.shear.precondition(destination, source);
      destination *= 1. / x.scale;
    };
    precondition(z1, x.r1);
    double before = 0.;
    for (bool first = true;; first = false)
      {
        mass.precondition(w, x.r2);
        const double z1_r1 = z1 * x.r1;
        x.norm             = std::sqrt(std::max(0., x.scale * z1_r1 + w * x.r2));
        x.converged        = x.norm <= target;
        std::ostringstream text;
        text << "mixed form, iteration " << x.iterations << ", residual over tolerance "
             << x.norm / target;
        log.progress(text.str());
        if (x.converged || x.iterations >= parameters.max_iterations || !std::isfinite(x.norm))
          return;

        model.shear.matrix().vmult(Az, z1);
        divergence.vmult(Bz, z1);
        mass.precondition(z2, Bz);
        z2 -= w;
        const double z1_Az = z1 * Az;
        if (!(z1_Az > z1_r1))
          {
            // The Rayleigh quotient bounds the scale.
            x.scale *= 0.8 * z1_Az / z1_r1;
            return;
          }
        const double square = z1_Az - z1_r1 + z2 * Bz - z2 * x.r2;
        const double beta   = first ? 0. : square / before;
        before              = square;
        const auto advance  = [&](Vector &direction, const Vector &z) {
          if (first)
            direction = z;
          else
            direction.sadd(beta, 1., z);
        };
        advance(d1, z1);
        advance(d2, z2);
        advance(Ad, Az);
        advance(Bd, Bz);

        q1 = Ad;
        divergence.add_transposed(q1, d2);
        mass.vmult_compliance(q2, d2);
        q2.sadd(-1., 1., Bd);
        precondition(v1, q1);
        const double curvature = v1 * q1 - q1 * d1 - q2 * d2;
        if (!(curvature > 0.))
          {
            x.scale *= 0.7;
            return;
          }
        const double alpha = square / curvature;
        x.u.add(alpha, d1);
        x.p.add(alpha, d2);
        x.r1.add(-alpha, q1);
        x.r2.add(-alpha, q2);
        z1.add(-alpha, v1);
        ++x.iterations;
      }
  }

  LinearResult
  MixedSolver::solve(const Vector        &forces,
                     const LinearStop    &stop,
                     Vector              &u,
                     mesh::PressureField &pressure) const
  {
    const double norm = load_norm(forces);
    if (!std::isfinite(norm))
      throw core::NumericalError("The loads are not finite. Look at their values and at the "
                                 "material constants.");
    if (norm == 0.)
      {
        for (unsigned int node = 0; node < model.space.n_owned_nodes(); ++node)
          for (unsigned int c = 0; c < 3; ++c)
            u.local_element(3 * node + c)
              = model.prescribed.values[model.space.field_node(node)][c];
        std::fill(pressure.values.begin(), pressure.values.end(), 0.);
        return {0, 0, 0., "nothing to solve: no load"};
      }
    Iterate x{u, volume_load, forces, volume_load};
    for (unsigned int node = 0; node < pressures.n_owned_nodes(); ++node)
      x.p.local_element(node) = pressure.values[pressures.field_node(node)];
    const double tolerance = stop.residual > 0. ? stop.residual : parameters.tolerance;
    const double target    = std::max(tolerance * norm, stop.algebraic_error / error_factor);
    // A restart takes the scale down by a fifth or more; and the preconditioner may be of single
    // precision, so that what the steps say of the residual is checked.
    for (unsigned int restart = 0; restart < 40; ++restart)
      {
        const unsigned int before = x.iterations;
        iterate(forces, target, x);
        if ((x.converged && x.iterations == before) || x.iterations >= parameters.max_iterations
            || !std::isfinite(x.norm))
          break;
      }
    if (!x.converged)
      {
        std::ostringstream message;
        message << "The iteration of the mixed form did not converge: after " << x.iterations
                << " iterations the residual is " << x.norm / target
                << " times the allowed one. Look for materials of very different stiffness or very "
                   "flat elements, or raise Solver/Maximum iterations.";
        throw core::NumericalError(message.str());
      }
    Vector product(x.p);
    for (const Vector &constant : free_pressures)
      {
        mass.vmult(product, constant);
        x.p.add(-(product * x.p) / (product * constant), constant);
      }
    u = x.u;
    pressures.gather(x.p, pressure.values);
    return {x.iterations, x.iterations, error_factor * x.norm, "mixed form, p-multigrid on AMG"};
  }
} // namespace tetradapt::solve
