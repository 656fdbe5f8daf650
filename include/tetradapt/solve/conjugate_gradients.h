// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_conjugate_gradients_h
#define tetradapt_solve_conjugate_gradients_h

#include "tetradapt/core/log.h"
#include "tetradapt/mechanics/block_matrix.h"
#include "tetradapt/solve/preconditioners.h"

#include <optional>
#include <vector>

namespace tetradapt::solve
{
  /**
   * Estimates the error that conjugate gradients leave, in the energy norm, from what
   * their steps gain.
   *
   * Step k takes alpha_k (r_k, z_k) off the square of the error (Hestenes and Stiefel,
   * J. Res. NBS 49, 1952), so the square of the error is the sum of all gains to come
   * (Strakos and Tichy, ETNA 13, 2002). They wait some steps to see most of that sum;
   * here the coming gains are continued as a geometric series with the rate of the last
   * ones (but at least 0.2), so that no step is made for the estimate alone.
   */
  class EnergyErrorEstimate
  {
  public:
    /** Adds the gain of one step. */
    void
    add(double gain)
    {
      gains.push_back(gain);
      total += gain;
    }

    /** Square of the energy norm of the present error; empty while too few steps were
     * made, or if the gains do not fall yet. */
    std::optional<double>
    squared_error() const;

    /** Sum of all gains: the square of the energy norm of what was added to the first
     * iterate. */
    double
    gained() const
    {
      return total;
    }

    /** Factor by which a step reduces the square of the error: the slower of the mean
     * over all steps and that of the last few; empty where there is no estimate. */
    std::optional<double>
    rate() const;

  private:
    /** How many gains are summed: single ones rise and fall from step to step. */
    std::size_t
    width() const;
    double
    sum(std::size_t begin) const;

    std::vector<double> gains;
    double              total = 0.;
  };

  /** When conjugate gradients end: when the residual or the error is reached. */
  struct IterationLimits
  {
    double       residual       = 0.; ///< l2 norm
    double       error          = 0.; ///< energy norm, estimated; 0: does not count
    double       relative_error = 0.; ///< relative to all gains, the norm of x from zero on
    unsigned int max_iterations = 0;
    /** From this iteration on, end where the residual is predicted to need more than
     * max_iterations; 0: go on to max_iterations in any case. */
    unsigned int give_up_from = 0;
  };

  struct IterationResult
  {
    bool converged = false;
    /** The preconditioner or the matrix was not positive, to rounding. */
    bool broke_down = false;
    /** Ended early by IterationLimits::give_up_from. */
    bool         gave_up    = false;
    unsigned int iterations = 0;
    double       residual   = 0.; ///< l2 norm
    double       error      = 0.; ///< estimated energy norm; 0: unknown
    /** Norm of the residual by the preconditioner, the root of (r, M^-1 r), about: that of
     * the error in the energy norm, as far as the preconditioner is an inverse. */
    double preconditioned_residual = 0.;
    double gained                  = 0.; ///< square of the energy norm of what was added to x
    /** How many iterations the residual needs in all: those made, where it was
     * reached, else continued with the mean rate of the error so far. */
    unsigned int iterations_to_residual = 0;
  };

  /** Preconditioned conjugate gradients for matrix x = right-hand side from @p x on.
   * Collective. */
  IterationResult
  conjugate_gradients(const mechanics::LinearOperator<double> &matrix,
                      const Preconditioner                    &preconditioner,
                      const Vector                            &right_hand_side,
                      const IterationLimits                   &limits,
                      const core::Log                         &log,
                      Vector                                  &x);
} // namespace tetradapt::solve

#endif
