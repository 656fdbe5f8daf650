// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

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

  GainControl::State
  GainControl::check(const unsigned int step, const double residual)
  {
    lstep  = step;
    lvalue = residual;
    if (!std::isfinite(residual))
      {
        failure       = Ending::not_finite;
        return lcheck = State::failure;
      }
    // Of a preconditioner that is not positive nothing good can come.
    if (step > 0 && residual > 0. && !(energy > 0.))
      {
        failure       = Ending::not_positive;
        return lcheck = State::failure;
      }
    lcheck  = decide(step, residual, step == 0 ? 0. : energy * (energy / curvature));
    started = true;
    return lcheck;
  }

  EnergyControl::EnergyControl(const IterationLimits                    &limits,
                               std::function<void(unsigned int, double)> progress)
    : limits(limits), progress(std::move(progress))
  {
  }

  GainControl::State
  EnergyControl::decide(const unsigned int step, const double residual, const double gain)
  {
    const double last  = reached.residual;
    reached.iterations = step;
    reached.residual   = residual;
    if (step == 0)
      {
        first_residual    = residual;
        reached.converged = residual <= limits.residual;
      }
    else
      {
        // Its own would take another application of the preconditioner.
        reached.preconditioned_residual
          = std::sqrt(std::max(0., preconditioned_square())) * (residual / last);
        estimate.add(gain);
        reached.converged = is_done();
        reached.gave_up   = !reached.converged && is_hopeless();
        if (progress)
          progress(step, residual / limits.residual);
      }
    return reached.converged                                  ? State::success
           : reached.gave_up || step >= limits.max_iterations ? State::failure
                                                              : State::iterate;
  }

  bool
  EnergyControl::is_done() const
  {
    if (reached.residual <= limits.residual)
      return true;
    const auto   squared = estimate.squared_error();
    const double allowed = std::max(limits.error * limits.error,
                                    std::pow(limits.relative_error, 2) * estimate.gained());
    return squared && *squared <= allowed;
  }

  unsigned int
  EnergyControl::predicted_iterations() const
  {
    const auto rate = estimate.rate();
    if (reached.residual <= limits.residual || !rate)
      return reached.iterations;
    // The residual falls like the energy norm of the error.
    const double more = 2. * std::log(limits.residual / reached.residual) / std::log(*rate);
    return reached.iterations + static_cast<unsigned int>(std::min(1e6, std::ceil(more)));
  }

  bool
  EnergyControl::is_hopeless() const
  {
    // Looked at now and then only: the rate sums over all steps.
    return limits.give_up_from > 0 && reached.iterations >= limits.give_up_from
           && reached.iterations % 10 == 0 && predicted_iterations() > limits.most_predicted;
  }

  IterationResult
  EnergyControl::result() const
  {
    IterationResult result = reached;
    result.residual        = last_value(); // also one that is not finite
    result.gained          = estimate.gained();
    // Too few steps for an estimate: the error falls like the residual.
    const double like_residual = first_residual > 0. ? result.residual / first_residual : 0.;
    result.error               = std::sqrt(
      estimate.squared_error().value_or(estimate.gained() * like_residual * like_residual));
    result.iterations_to_residual = predicted_iterations();
    return result;
  }
} // namespace tetradapt::solve
