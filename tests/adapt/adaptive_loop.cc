// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The loop: the order of its steps, each of which may end it, and what a solver may leave.

#include "tetradapt/adapt/adaptive_loop.h"

#include <iostream>

using namespace tetradapt::adapt;

namespace
{
  /** Says what it does; the error is halved by each mesh. */
  class Halving : public AdaptiveLoop
  {
  public:
    /** Ends in cycle @p last by @p step. */
    Halving(const std::string &step, const unsigned int last) : step(step), last(last)
    {
    }

    void
    run()
    {
      const StopDecision decision = run_cycles();
      std::cout << "ended by " << decision.text << std::endl;
    }

  private:
    void
    solve(const unsigned int number) override
    {
      cycle = number;
      std::cout << "solve " << number << " to " << solver_error(.1);
    }
    void
    estimate() override
    {
      std::cout << ", estimate";
    }
    StopDecision
    decide() override
    {
      return end("decide");
    }
    StopDecision
    mark() override
    {
      return end("mark");
    }
    StopDecision
    refine() override
    {
      error *= .5;
      expect_error(error);
      return end("refine");
    }

    StopDecision
    end(const std::string &present)
    {
      StopDecision decision;
      if (present == step && cycle == last)
        {
          decision.reason = StopReason::max_cycles;
          decision.text   = present;
        }
      std::cout << ", " << present << (decision.stop() || present == "refine" ? "\n" : "");
      return decision;
    }

    std::string  step;
    unsigned int last, cycle = 0;
    double       error = 1.;
  };
} // namespace

int
main()
{
  Halving("decide", 2).run();
  Halving("mark", 0).run();
  Halving("refine", 1).run();
}
