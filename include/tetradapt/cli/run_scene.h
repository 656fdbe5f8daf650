// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_run_scene_h
#define tetradapt_cli_run_scene_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/core/interrupt_watcher.h"
#include "tetradapt/scene/scene.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace tetradapt::cli
{
  /** What the command line says about a run in addition to the scene. */
  struct RunOptions
  {
    bool        quiet   = false; ///< only warnings and errors on stderr, nothing on stdout
    bool        brief   = false; ///< nothing but progress, warnings and errors on stderr
    bool        verbose = false; ///< plan, meshes, solvers and times on stderr also
    std::string command_line;    ///< as it was typed, for the log
    /** Is told how to end a run in good order; may be null. */
    core::InterruptWatcher *interrupts = nullptr;
  };

  /**
   * Runs one scene: prints its warnings and its plan, computes, and writes its
   * output. Collective; several calls may follow each other in one process.
   *
   * @param scene a scene that scene::read_scene() returned.
   * @param effective_parameters its complete input, for output/parameters.prm.
   * @param more observers in addition to those that the scene asks for; told on the first rank.
   * @throws InputError, NumericalError. Errors that concern all ranks are thrown
   *         on all ranks; the caller prints them (once), adds the place of the
   *         parameter (scene::Scene::with_place()) and sets the exit code.
   */
  void
  run_scene(const scene::Scene                   &scene,
            const std::string                    &effective_parameters,
            const RunOptions                     &options,
            MPI_Comm                              communicator,
            const std::vector<adapt::Observer *> &more = {});
} // namespace tetradapt::cli

#endif
