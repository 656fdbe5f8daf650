// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace tetradapt::solve
{
  std::size_t
  EnergyErrorEstimate::width() const
  {
    return gains.size() >= 6 ? 3 : 2;
  }

  double
  EnergyErrorEstimate::sum(std::size_t begin) const
  {
    return std::accumulate(gains.begin() + begin, gains.begin() + begin + width(), 0.);
  }

  std::optional<double>
  EnergyErrorEstimate::rate() const
  {
    const std::size_t n = gains.size(), w = width();
    if (n < 2 * w)
      return std::nullopt;
    const double late = sum(n - w);
    // Where convergence pauses, the last steps alone look too good before or after.
    const double recent = std::pow(late / sum(n - 2 * w), 1. / w);
    const double mean   = std::pow(late / sum(0), 1. / (n - w));
    const double rate   = std::max(recent, mean);
    return rate < 1. ? std::optional<double>(rate) : std::nullopt;
  }

  std::optional<double>
  EnergyErrorEstimate::squared_error() const
  {
    const auto factor = rate();
    if (!factor)
      return std::nullopt;
    // First steps gain more than those to come: a better rate is not to be relied on.
    const double late = std::pow(std::max(*factor, 0.2), width());
    return sum(gains.size() - width()) * late / (1. - late);
  }

  namespace
  {
    bool
    is_done(const IterationLimits &limits, double residual, const EnergyErrorEstimate &estimate)
    {
      if (residual <= limits.residual)
        return true;
      const auto   squared = estimate.squared_error();
      const double allowed = std::max(limits.error * limits.error,
                                      std::pow(limits.relative_error, 2) * estimate.gained());
      return squared && *squared <= allowed;
    }

    unsigned int
    predict(const IterationResult     &result,
            const IterationLimits     &limits,
            const EnergyErrorEstimate &estimate)
    {
      const auto rate = estimate.rate();
      if (result.residual <= limits.residual || !rate)
        return result.iterations;
      // The residual falls like the energy norm of the error.
      const double more = 2. * std::log(limits.residual / result.residual) / std::log(*rate);
      return result.iterations + static_cast<unsigned int>(std::min(1e6, std::ceil(more)));
    }

    bool
    is_hopeless(const IterationResult     &result,
                const IterationLimits     &limits,
                const EnergyErrorEstimate &estimate)
    {
      // Looked at now and then only: the rate sums over all steps.
      return limits.give_up_from > 0 && result.iterations >= limits.give_up_from
             && result.iterations % 10 == 0
             && predict(result, limits, estimate) > limits.max_iterations;
    }
  } // namespace

  IterationResult
  conjugate_gradients(const mechanics::LinearOperator<double> &matrix,
                      const Preconditioner                    &preconditioner,
                      const Vector                            &right_hand_side,
                      const IterationLimits                   &limits,
                      const core::Log                         &log,
                      Vector                                  &x)
  {
    Vector residual(right_hand_side), preconditioned, direction, product;
    for (Vector *vector : {&preconditioned, &direction, &product})
      vector->reinit(right_hand_side, true);
    if (!x.all_zero())
      {
        matrix.vmult(product, x);
        residual -= product;
      }

    EnergyErrorEstimate estimate;
    IterationResult     result;
    result.residual             = residual.l2_norm();
    const double first_residual = result.residual;
    result.converged            = result.residual <= limits.residual;
    double energy               = 0.; // (r, z)
    while (!result.converged && !result.gave_up && result.iterations < limits.max_iterations
           && std::isfinite(result.residual))
      {
        preconditioner.vmult(preconditioned, residual);
        const double before = energy;
        energy              = residual * preconditioned;
        if (result.iterations == 0)
          direction = preconditioned;
        else
          direction.sadd(energy / before, 1., preconditioned);
        matrix.vmult(product, direction);
        const double curvature = direction * product;
        result.broke_down      = !(energy > 0. && curvature > 0.);
        if (result.broke_down)
          break;
        const double alpha = energy / curvature;
        x.add(alpha, direction);
        const double last = result.residual;
        result.residual   = std::sqrt(residual.add_and_dot(-alpha, product, residual));
        // Its own would take another application of the preconditioner.
        result.preconditioned_residual = std::sqrt(energy) * (result.residual / last);
        ++result.iterations;
        estimate.add(alpha * energy);
        result.converged = is_done(limits, result.residual, estimate);
        result.gave_up   = !result.converged && is_hopeless(result, limits, estimate);

        std::ostringstream text;
        text << "conjugate gradients, iteration " << result.iterations
             << ", residual over tolerance " << result.residual / limits.residual;
        log.progress(text.str());
      }
    if (result.iterations == 0 && result.residual > 0.)
      {
        preconditioner.vmult(preconditioned, residual);
        result.preconditioned_residual = std::sqrt(std::max(0., residual * preconditioned));
      }
    result.gained = estimate.gained();
    // Too few steps for an estimate: the error falls like the residual.
    const double like_residual = first_residual > 0. ? result.residual / first_residual : 0.;
    result.error               = std::sqrt(
      estimate.squared_error().value_or(estimate.gained() * like_residual * like_residual));
    result.iterations_to_residual = predict(result, limits, estimate);
    return result;
  }
} // namespace tetradapt::solve
