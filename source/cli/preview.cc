// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/preview.h"

#include "tetradapt/adapt/mesh_maker.h"
#include "tetradapt/adapt/placement.h"
#include "tetradapt/cli/outcome.h"
#include "tetradapt/core/on_first_rank.h"
#include "tetradapt/core/printable.h"
#include "tetradapt/mechanics/supports.h"
#include "tetradapt/report/log_sinks.h"
#include "tetradapt/report/mesh_summary.h"
#include "tetradapt/report/preview.h"
#include "tetradapt/report/result_folder.h"

#include <iostream>

namespace tetradapt::cli
{
  namespace
  {
    void
    show(const scene::Scene   &scene,
         const std::string    &directory,
         const bool            quiet,
         const adapt::NewMesh &made,
         const core::Log      &log)
    {
      log.info("First mesh: " + report::mesh_line(*made.mesh, made.record));
      report::ResultFolder folder(directory);
      const std::string    file = folder.prepare("preview.vtu");
      report::write_preview(file, scene, *made.mesh);
      if (!quiet)
        {
          std::cout << core::printable(report::preview_tables(scene, *made.mesh)
                                       + "\nThe surface is in " + file + ".\n");
          require_written(std::cout);
        }
      for (const auto &warning : scene.warnings())
        log.warning(warning);
      adapt::check_placement(scene, made.mesh, log);
      mechanics::prescribe(scene.supports, *made.mesh, nullptr, scene.mesh);
    }
  } // namespace

  void
  preview(const scene::Scene &scene,
          const std::string  &directory,
          const bool          quiet,
          MPI_Comm            communicator)
  {
    core::Log                             log;
    std::unique_ptr<report::TerminalSink> terminal;
    core::on_first_rank(communicator, [&]() {
      terminal
        = std::make_unique<report::TerminalSink>(log,
                                                 std::cerr,
                                                 report::TerminalSink::stderr_options(quiet));
    });
    adapt::MeshMaker     maker(scene, communicator, log);
    const adapt::NewMesh made = maker.initial(0);
    core::on_first_rank(communicator, [&]() { show(scene, directory, quiet, made, log); });
  }
} // namespace tetradapt::cli
