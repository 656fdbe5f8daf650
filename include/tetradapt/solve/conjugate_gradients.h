// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_conjugate_gradients_h
#define tetradapt_solve_conjugate_gradients_h

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/vector_memory.h>

#include <cmath>
#include <functional>
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
     * most_predicted; 0: go on to max_iterations in any case. */
    unsigned int give_up_from   = 0;
    unsigned int most_predicted = 0;
  };

  struct IterationResult
  {
    bool converged = false;
    /** Ended since the matrix is not positive definite, as far as can be told. */
    bool is_indefinite = false;
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

  /** How conjugate gradients ended. */
  enum class Ending
  {
    converged,
    stopped,      ///< by the control
    not_positive, ///< the preconditioner, or the matrix in rounding
    indefinite,   ///< the matrix has a direction of negative energy
    not_finite
  };

  /**
   * A control of conjugate gradients that knows what each step gains: alpha_k (r_k, z_k) =
   * (r_k, z_k)^2 / (p_k, A p_k). deal.II's solver tells beta_k = (r_k, z_k) / (r_k-1, z_k-1); the
   * rest is seen by what conjugate_gradients() lays around matrix and preconditioner.
   */
  class GainControl : public dealii::SolverControl
  {
  public:
    /** Ends with failure where the residual is not finite, or (r, z) not positive. */
    State
    check(unsigned int step, double residual) final;

    /** Why it ended, if it did with failure. */
    Ending
    reason() const
    {
      return failure;
    }

    /** For the solver: another solution begins. */
    void
    restart()
    {
      started = false;
      failure = Ending::stopped;
    }

    /** For the solver: (r_0, z_0). */
    void
    set_first_energy(const double value)
    {
      energy = value;
    }
    /** For the solver. */
    void
    multiply_energy(const double beta)
    {
      energy *= beta;
    }
    /** For the solver: (p, A p) of the step that follows. */
    void
    set_curvature(const double value)
    {
      curvature = value;
    }
    /** For the solver: the first residual is known, and steps follow. */
    bool
    is_started() const
    {
      return started;
    }

  protected:
    /** Decides after each step; @p gain is zero for the first residual, with step = 0. */
    virtual State
    decide(unsigned int step, double residual, double gain)
      = 0;

    /** (r, z) of the last step. */
    double
    preconditioned_square() const
    {
      return energy;
    }

  private:
    double energy = 0., curvature = 0.;
    bool   started = false;
    Ending failure = Ending::stopped;
  };

  /** Ends conjugate gradients by IterationLimits, and tells how far they have come. */
  class EnergyControl : public GainControl
  {
  public:
    /** @param progress is told the residual by the allowed one after each step; may be empty. */
    explicit EnergyControl(const IterationLimits                                  &limits,
                           std::function<void(unsigned int step, double relative)> progress = {});

    /** What was reached. */
    IterationResult
    result() const;

  protected:
    State
    decide(unsigned int step, double residual, double gain) override;

  private:
    bool
    is_done() const;
    /** How many iterations the residual needs. */
    unsigned int
    predicted_iterations() const;
    bool
    is_hopeless() const;

    IterationLimits                           limits;
    std::function<void(unsigned int, double)> progress;
    EnergyErrorEstimate                       estimate;
    IterationResult                           reached;
    double                                    first_residual = 0.;
  };

  namespace internal
  {
    /** Thrown before a step that cannot be made. */
    struct NoStep
    {
      Ending reason;
    };

    /** Tells a control the curvature along the directions that a matrix is multiplied with. */
    template <typename Matrix>
    struct ObservedMatrix
    {
      const Matrix &matrix;
      GainControl  &control;

      template <typename VectorType>
      void
      vmult(VectorType &destination, const VectorType &source) const
      {
        matrix.vmult(destination, source);
        if (!control.is_started()) // the first residual
          return;
        const double curvature = source * destination;
        if (!std::isfinite(curvature))
          throw NoStep{Ending::not_finite};
        if (!(curvature > 0.))
          throw NoStep{curvature < 0. ? Ending::indefinite : Ending::not_positive};
        control.set_curvature(curvature);
      }
    };

    /** Tells a control (r, z) of the first step. */
    template <typename Preconditioner>
    struct ObservedPreconditioner
    {
      const Preconditioner &preconditioner;
      GainControl          &control;
      mutable bool          is_first = true;

      template <typename VectorType>
      void
      vmult(VectorType &destination, const VectorType &source) const
      {
        preconditioner.vmult(destination, source);
        if (is_first)
          control.set_first_energy(source * destination);
        is_first = false;
      }
    };
  } // namespace internal

  /**
   * deal.II's conjugate gradients for matrix x = @p right_hand_side from @p x on, until
   * @p control ends them. Collective if the vectors are distributed.
   * @param matrix has vmult(), is symmetric and positive; so is @p preconditioner.
   * @param x stays what it was if it would not be finite.
   */
  template <typename Matrix, typename Preconditioner, typename VectorType>
  Ending
  conjugate_gradients(const Matrix         &matrix,
                      const Preconditioner &preconditioner,
                      const VectorType     &right_hand_side,
                      GainControl          &control,
                      VectorType           &x)
  {
    VectorType start;
    const bool from_zero = x.all_zero();
    if (!from_zero)
      start = x;
    control.restart();
    dealii::PrimitiveVectorMemory<VectorType> memory; // the default one keeps its vectors
    dealii::SolverCG<VectorType>              solver(control, memory);
    solver.connect_coefficients_slot(
      [&](const double, const double beta) { control.multiply_energy(beta); });
    Ending ending = Ending::converged;
    try
      {
        solver.solve(internal::ObservedMatrix<Matrix>{matrix, control},
                     x,
                     right_hand_side,
                     internal::ObservedPreconditioner<Preconditioner>{preconditioner, control});
        // A failure at the first residual is not thrown.
        if (control.last_check() != dealii::SolverControl::success)
          ending = control.reason();
      }
    catch (const internal::NoStep &none)
      {
        ending = none.reason;
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        ending = control.reason();
      }
    // Not by squares, which overflow for large displacements.
    if (!std::isfinite(x.l1_norm()))
      {
        if (from_zero)
          x = 0.;
        else
          x = start;
        ending = Ending::not_finite;
      }
    return ending;
  }
} // namespace tetradapt::solve

#endif
