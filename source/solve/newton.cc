// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/newton.h"

#include "tetradapt/solve/indefinite_matrix.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::solve
{
  namespace
  {
    /** Part of the decrease by the slope that a step must reach (Armijo). */
    constexpr double enough_decrease = 1e-4;
    /** A step that makes the residual this much smaller is taken even if the potential rises. */
    constexpr double       enough_reduction = 0.5;
    constexpr unsigned int max_halvings     = 10;
    /** A residual of this many times the rounding in it is rounding. */
    constexpr double floor_factor = 4.;

    /** Eisenstat and Walker's choice 2 with gamma = 0.9 and alpha = 2, and their safeguard. */
    double
    linear_tolerance(const double before, const double now, const double last)
    {
      const double ratio = now / before;
      double       value = 0.9 * ratio * ratio;
      if (0.9 * last * last > 0.1)
        value = std::max(value, 0.9 * last * last);
      return value;
    }
  } // namespace

  Newton::State
  Newton::search(const Vector &step,
                 const double  slope,
                 const State  &before,
                 Vector       &x,
                 Vector       &r,
                 Ending       &failure) const
  {
    const Vector start(x);
    double       length = 1.;
    failure             = Ending::inadmissible;
    for (unsigned int halvings = 0; halvings <= max_halvings; ++halvings, length *= 0.5)
      {
        x.equ(1., start);
        x.add(length, step);
        const State state = residual(x, r);
        if (!state.is_admissible || !std::isfinite(state.residual))
          continue;
        failure = Ending::no_descent;
        if (state.potential <= before.potential + enough_decrease * length * slope + state.noise
            || state.residual <= enough_reduction * before.residual)
          {
            failure = Ending::converged;
            return state;
          }
      }
    x.equ(1., start);
    return before;
  }

  Newton::Result
  Newton::solve(const Limits &limits, Vector &x) const
  {
    Result result;
    Vector r(x), step(x);
    State  state = residual(x, r);
    if (!state.is_admissible)
      {
        result.ending = Ending::inadmissible;
        return result;
      }
    // Without any force there is nothing to be relative to: the floor decides.
    const auto relative = [](const State &s) {
      return s.residual == 0. ? 0. : s.scale > 0. ? s.residual / s.scale : 1.;
    };
    result.residuals.push_back(relative(state));
    double linear = limits.first_linear;
    while (true)
      {
        const bool moves = moves_prescribed(x);
        if (!moves && result.residuals.back() <= limits.tolerance)
          return result;
        if (!moves && state.residual <= floor_factor * state.floor)
          {
            result.at_floor = true;
            return result;
          }
        if (result.steps() >= limits.max_steps)
          {
            result.ending = Ending::too_slow;
            return result;
          }
        step = 0.;
        try
          {
            setup_jacobian(x);
            // What is left after the last step need not be much smaller than asked for.
            const double goal = result.residuals.back() > 0.
                                  ? 0.3 * limits.tolerance / result.residuals.back()
                                  : linear;
            result.linear_iterations += solve_with_jacobian(
              x, r, std::min(0.1, std::max(linear, moves ? 0. : goal)), step);
          }
        catch (const IndefiniteMatrix &)
          {
            result.ending = Ending::indefinite;
            return result;
          }
        const State before = state;
        if (moves)
          {
            const Vector start(x);
            x += step;
            state = residual(x, r);
            if (!state.is_admissible || !std::isfinite(state.residual))
              {
                x             = start;
                result.ending = Ending::inadmissible;
                return result;
              }
            linear = limits.first_linear;
          }
        else
          {
            const double slope = -(r * step);
            if (!(slope < 0.))
              {
                result.ending = Ending::indefinite;
                return result;
              }
            Ending failure;
            state = search(step, slope, before, x, r, failure);
            if (failure != Ending::converged)
              {
                result.ending = failure;
                return result;
              }
            linear = std::min(limits.first_linear,
                              linear_tolerance(before.residual, state.residual, linear));
          }
        result.residuals.push_back(relative(state));
        if (progress)
          progress(result.steps(), result.residuals.back());
      }
  }
} // namespace tetradapt::solve
