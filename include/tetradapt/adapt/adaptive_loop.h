// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_adaptive_loop_h
#define tetradapt_adapt_adaptive_loop_h

#include "tetradapt/adapt/stopping.h"

namespace tetradapt::adapt
{
  /**
   * The loop SOLVE - ESTIMATE - MARK - REFINE, whose steps a derived class has. Where a process
   * runs on several ranks, all steps are collective, and their decisions are the same on every
   * rank.
   */
  class AdaptiveLoop
  {
  public:
    virtual ~AdaptiveLoop() = default;

  protected:
    /** Runs cycles until a step ends the loop. @throws what the steps throw. */
    StopDecision
    run_cycles();

    /** Says what error the next mesh is expected to have, in the energy norm; 0: it is unknown. */
    void
    expect_error(const double error)
    {
      expected_error = error;
    }

    /** The error that iterations on this mesh may leave, in the energy norm: @p fraction of the
     * mesh's own, as it was expected; 0: that is unknown. */
    double
    solver_error(const double fraction) const
    {
      return fraction * expected_error;
    }

  private:
    /** Solves on the present mesh. Cycles count from 0. */
    virtual void
    solve(unsigned int cycle)
      = 0;
    /** Finds the error and where it is. */
    virtual void
    estimate()
      = 0;
    /** Whether the loop ends with this solution. */
    virtual StopDecision
    decide()
      = 0;
    /** Chooses what is to be refined; ends the loop if there is nothing. */
    virtual StopDecision
    mark()
      = 0;
    /** Makes the next mesh; ends the loop if it cannot. */
    virtual StopDecision
    refine()
      = 0;

    double expected_error = 0.;
  };
} // namespace tetradapt::adapt

#endif
