// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_stage_timer_h
#define tetradapt_core_stage_timer_h

#include <string>
#include <vector>

namespace tetradapt::core
{
  /**
   * Adds up wall and CPU time by stage ("mesh", "solve", ...). At any moment
   * exactly one row runs: the innermost open scope, or "other" when none is open.
   * So a stage that is opened within another takes its time from it, every
   * moment is counted once, and the rows sum to the total.
   *
   * CPU time is that of all threads of this process and of the child processes
   * it has waited for (TetGen). One object serves one thread.
   */
  class StageTimer
  {
  public:
    /** Times of one row, seconds. */
    struct Row
    {
      std::string  stage;
      double       wall = 0., cpu = 0.;
      unsigned int calls = 0; ///< scopes opened
    };

    /** Runs a stage until it is destroyed. Scopes close in the reverse order of
     * their opening. */
    class Scope
    {
    public:
      Scope(StageTimer &timer, const std::string &stage);
      ~Scope();
      Scope(const Scope &) = delete;
      Scope &
      operator=(const Scope &)
        = delete;

    private:
      StageTimer &timer;
    };

    /** Starts counting "other". */
    StageTimer();

    /** Opens @p stage: `const auto scope = timer.scope("solve");`. Rows appear in
     * the order in which stages are first opened. */
    Scope
    scope(const std::string &stage);

    /** Wall seconds of @p stage until now; 0 for one that has not been opened. */
    double
    wall(const std::string &stage) const;

    /** CPU seconds of @p stage until now; 0 for one that has not been opened. */
    double
    cpu(const std::string &stage) const;

    /** Wall seconds since construction: the sum of all rows. */
    double
    total_wall() const;

    /** CPU seconds since construction: the sum of all rows. */
    double
    total_cpu() const;

    /** All rows until now, "other" last. */
    std::vector<Row>
    rows() const;

    /** An aligned table of rows() with shares of the wall time and a total. */
    std::string
    table() const;

  private:
    struct Clocks
    {
      double wall, cpu;
    };
    static Clocks
    now();

    /** Gives the time since the last call to the row that runs. */
    void
    charge();
    unsigned int
    row_number(const std::string &stage);

    Clocks                    last;
    std::vector<Row>          finished; ///< entry 0 is "other"
    std::vector<unsigned int> open;     ///< rows of the open scopes, innermost last
  };
} // namespace tetradapt::core

#endif
