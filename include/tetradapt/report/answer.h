// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_answer_h
#define tetradapt_report_answer_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/adapt/stopping.h"
#include "tetradapt/core/log.h"

#include <string>
#include <vector>

namespace tetradapt::report
{
  /**
   * What a run has found, for its last lines: the largest displacement and stress, reactions and
   * loads and how they balance, volume and mass, the goals; how wrong this is and who says so
   * (measured against what, estimated by which estimator, or bounded); whether the tolerances
   * are reached; and what to do next. Lines of at most 80 characters; long names are cut, long
   * lists end with the file that has the rest. Ends with a line end.
   *
   * @param record of the last accepted cycle.
   * @param decision why the run ended.
   */
  std::string
  answer_text(const scene::Scene        &scene,
              const adapt::CycleRecord  &record,
              const adapt::StopDecision &decision);

  /** What to do next after a run that ended with @p decision, as a sentence. */
  std::string
  advice(const scene::Scene        &scene,
         const adapt::CycleRecord  &record,
         const adapt::StopDecision &decision);

  /** Keeps what answer_text() needs until the run has ended. */
  class Answer : public adapt::Observer
  {
  public:
    void
    run_started(const scene::Scene &scene) override;
    void
    cycle_done(const adapt::CycleEvent &event) override;
    void
    run_done(const adapt::StopDecision &decision) override;

    /** The answer once the run has ended; empty before. */
    const std::string &
    text() const
    {
      return answer;
    }

  private:
    scene::Scene                      scene;
    std::optional<adapt::CycleRecord> last;
    std::string                       answer;
  };
} // namespace tetradapt::report

#endif
