// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_newton_h
#define tetradapt_solve_newton_h

#include "tetradapt/fem/space.h"

#include <functional>
#include <vector>

namespace tetradapt::solve
{
  using fem::Vector;

  /**
   * Newton's method with a line search for equations r(x) = 0 that come from a potential:
   * r = -dPi/dx. What the equations are is given by functions that are named as in deal.II's
   * interfaces to nonlinear solvers. All of them are collective.
   */
  class Newton
  {
  public:
    /** What is known of an iterate. */
    struct State
    {
      bool   is_admissible = false; ///< nothing else has a meaning if not
      double residual      = 0.;    ///< norm of r
      double scale         = 0.;    ///< what the residual's tolerance is relative to
      double potential     = 0.;    ///< Pi
      double noise         = 0.;    ///< rounding in Pi
      double floor         = 0.;    ///< rounding in the norm of r: no residual is less
    };

    struct Limits
    {
      double       tolerance    = 1e-8; ///< of the residual, relative to State::scale
      unsigned int max_steps    = 25;
      double       first_linear = 1e-2; ///< tolerance of the first linear solve
    };

    enum class Ending
    {
      converged,
      inadmissible, ///< not even a short step leads to an admissible state
      no_descent,   ///< the line search found no lower potential
      too_slow,     ///< Limits::max_steps
      indefinite    ///< the derivative is not positive definite
    };

    struct Result
    {
      Ending              ending            = Ending::converged;
      bool                at_floor          = false; ///< converged to State::floor only
      unsigned int        linear_iterations = 0;
      std::vector<double> residuals; ///< relative to the scale: of the start and after each step

      unsigned int
      steps() const
      {
        return residuals.empty() ? 0 : residuals.size() - 1;
      }
    };

    /** Computes r, called @p residual, at @p x. */
    std::function<State(const Vector &x, Vector &residual)> residual;

    /** Makes the derivative -dr/dx at @p x ready. */
    std::function<void(const Vector &x)> setup_jacobian;

    /**
     * Solves for a step: -dr/dx dx = @p residual, to a relative residual of @p tolerance.
     * @param step is zero at first; where values are prescribed that x does not have yet, the
     *        step must lead to them.
     * @param x where setup_jacobian() was called last.
     * @return iterations.
     * @throws IndefiniteMatrix, on all ranks, which ends solve() with Ending::indefinite; other
     *         errors leave it.
     */
    std::function<
      unsigned int(const Vector &x, const Vector &residual, double tolerance, Vector &step)>
      solve_with_jacobian;

    /** Whether the next step leads to prescribed values that x does not have yet: then it is
     * taken whole, and the potential may rise. */
    std::function<bool(const Vector &x)> moves_prescribed;

    /** Called after each step, for the log. May be empty. */
    std::function<void(unsigned int step, double relative_residual)> progress;

    /**
     * Goes on from @p x, which must be admissible where nothing prescribed moves. Linear solves
     * are as exact as the residual falls (Eisenstat and Walker 1996, their second choice).
     * Ends when the residual is below the tolerance or a few times State::floor.
     * Afterwards @p x is the last admissible iterate, also where solve() did not converge.
     */
    Result
    solve(const Limits &limits, Vector &x) const;

  private:
    State
    search(const Vector &step,
           double        slope,
           const State  &before,
           Vector       &x,
           Vector       &r,
           Ending       &failure) const;
  };
} // namespace tetradapt::solve

#endif
