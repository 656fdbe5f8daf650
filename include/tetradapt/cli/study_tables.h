// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_study_tables_h
#define tetradapt_cli_study_tables_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/cli/load_scene.h"

#include <string>
#include <vector>

namespace tetradapt::cli
{
  /** What a run of a study came to. */
  struct StudyOutcome
  {
    std::vector<adapt::CycleRecord> records;           ///< of the cycles that it finished
    bool                            is_done   = false; ///< it has been run
    bool                            is_failed = false;
  };

  /**
   * study.csv: the run's name, for each variation the label of its case and the values of its
   * parameters, then the columns of convergence.csv; a row a cycle of every run.
   */
  std::string
  csv_study(const scene::Scene              &study,
            const std::vector<StudyRun>     &runs,
            const std::vector<StudyOutcome> &outcomes);

  /** study.txt: a row a run, with the figures of the last cycle that was accepted and the
   * time of all.
   * @param most_characters of a line, for a screen: columns are left out until it has room, and
   * the names of runs are cut; 0: no limit. */
  std::string
  text_study(const std::vector<StudyRun>     &runs,
             const std::vector<StudyOutcome> &outcomes,
             unsigned int                     most_characters = 0);
} // namespace tetradapt::cli

#endif
