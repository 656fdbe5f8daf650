// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_preview_h
#define tetradapt_cli_preview_h

#include "tetradapt/scene/scene.h"

#include <mpi.h>

#include <string>

namespace tetradapt::cli
{
  /**
   * Makes the first mesh of @p scene, writes preview.vtu (report::write_preview()) into
   * @p directory, which is made if it is missing, and prints report::preview_tables() on stdout;
   * solves nothing and touches no other file. Then checks, as a run would, that supports hold the
   * body, that loads act where nothing holds them and that the points of goals lie inside.
   * Collective.
   *
   * @param quiet only warnings and errors on stderr, nothing on stdout.
   * @throws core::InputError, core::NumericalError as a run would before its first solution.
   */
  void
  preview(const scene::Scene &scene,
          const std::string  &directory,
          bool                quiet,
          MPI_Comm            communicator);
} // namespace tetradapt::cli

#endif
