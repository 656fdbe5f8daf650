// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/preview.h"

#include "tetradapt/adapt/mesh_maker.h"
#include "tetradapt/adapt/placement.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/on_first_rank.h"
#include "tetradapt/mechanics/supports.h"
#include "tetradapt/report/log_sinks.h"
#include "tetradapt/report/mesh_summary.h"
#include "tetradapt/report/preview.h"

#include <filesystem>
#include <iostream>

namespace tetradapt::cli
{
  namespace
  {
    void
    make_directory(const std::string &directory)
    {
      std::error_code error;
      std::filesystem::create_directories(directory, error);
      if (!std::filesystem::is_directory(directory))
        throw core::InputError("Output/Directory: '" + directory + "' cannot be made"
                               + (error ? ": " + error.message() : "")
                               + ". Choose another folder.");
    }

    void
    show(const scene::Scene   &scene,
         const std::string    &directory,
         const bool            quiet,
         const adapt::NewMesh &made,
         const core::Log      &log)
    {
      const std::string file = directory + "/preview.vtu";
      log.info("First mesh: " + report::mesh_line(*made.mesh, made.record));
      make_directory(directory);
      report::write_preview(file, scene, *made.mesh);
      if (!quiet)
        std::cout << report::preview_tables(scene, *made.mesh) << "\nThe surface is in " << file
                  << "." << std::endl;
      for (const auto &warning : scene.warnings())
        log.warning(warning);
      adapt::check_placement(scene, made.mesh, log);
      mechanics::prescribe(scene.supports, *made.mesh, nullptr);
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
