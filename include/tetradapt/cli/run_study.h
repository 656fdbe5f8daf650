// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_run_study_h
#define tetradapt_cli_run_study_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/cli/load_scene.h"
#include "tetradapt/cli/run_scene.h"

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
   * time of all. */
  std::string
  text_study(const std::vector<StudyRun> &runs, const std::vector<StudyOutcome> &outcomes);

  /**
   * Runs all @p runs of @p study one after another, each as run_scene() does, and writes
   * study.csv (after every run), study.txt and, if the scene wants plots, the plots of
   * all. Collective.
   *
   * Before the first, meshes and selections of all are checked as by --validate. A run that
   * fails is reported (as conclude() does) and the next one begins.
   * @param control a communicator of the same ranks for agreeing on outcomes.
   * @return the largest exit code.
   * @throws InputError if the input of a run is wrong or the folder cannot be written.
   */
  int
  run_study(const scene::Scene          &study,
            const std::vector<StudyRun> &runs,
            const RunOptions            &options,
            MPI_Comm                     communicator,
            MPI_Comm                     control);

  /** Checks the input of all runs that differ in it, by check_inputs(). @throws InputError
   * naming the run. */
  void
  check_study_inputs(const scene::Scene &study, const std::vector<StudyRun> &runs);
} // namespace tetradapt::cli

#endif
