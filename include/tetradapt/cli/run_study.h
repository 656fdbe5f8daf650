// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_run_study_h
#define tetradapt_cli_run_study_h

#include "tetradapt/cli/run_scene.h"
#include "tetradapt/cli/study_tables.h"
#include "tetradapt/core/log.h"
#include "tetradapt/scene/mistakes.h"

#include <vector>

namespace tetradapt::cli
{
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

  /** Checks the input of all runs that differ in it, by check_inputs(); @p mistakes gets what is
   * wrong, with the names of the runs. */
  void
  check_study_inputs(const scene::Scene          &study,
                     const std::vector<StudyRun> &runs,
                     scene::Mistakes             &mistakes,
                     const core::Log             &log);
} // namespace tetradapt::cli

#endif
