// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/run_scene.h"

#include "tetradapt/adapt/driver.h"
#include "tetradapt/core/on_first_rank.h"
#include "tetradapt/report/convergence_table.h"
#include "tetradapt/report/log_sinks.h"
#include "tetradapt/report/mesh_report.h"
#include "tetradapt/report/mesh_summary.h"
#include "tetradapt/report/output_directory.h"
#include "tetradapt/report/plots.h"
#include "tetradapt/report/results.h"
#include "tetradapt/report/size_field_file.h"
#include "tetradapt/report/vtu_series.h"
#include "tetradapt/scene/plan.h"

#include <deal.II/base/mpi.h>

#include <iostream>
#include <memory>

namespace tetradapt::cli
{
  namespace
  {
    report::TerminalSink::Options
    sink_options(const RunOptions &options)
    {
      auto sink    = report::TerminalSink::stderr_options(options.quiet);
      sink.brief   = options.brief;
      sink.verbose = options.verbose;
      return sink;
    }

    /** What watches a run on the first rank; empty on the others. */
    class Watchers
    {
    public:
      Watchers(const scene::Scene &scene,
               const std::string  &effective_parameters,
               const RunOptions   &options,
               core::Log          &log)
        : log(log),
          terminal(std::make_unique<report::TerminalSink>(log, std::cerr, sink_options(options))),
          directory(scene), log_file(log, directory.file("log.txt"))
      {
        directory.write_parameters(effective_parameters);
        const std::string tables = scene.output.tables ? directory.path() : "";
        std::ostream     *rows   = options.quiet ? nullptr : &std::cout;
        if (rows != nullptr || scene.output.tables)
          observers.push_back(std::make_unique<report::ConvergenceTable>(tables, rows, log));
        observers.push_back(std::make_unique<report::MeshReport>(tables, log));
        observers.push_back(std::make_unique<report::ResultsSummary>(tables, log));
        if (scene.output.plots)
          observers.push_back(std::make_unique<report::RunPlots>(directory.path(), log));
        if (scene.output.size_field)
          observers.push_back(std::make_unique<report::SizeFieldFile>(directory.path()));
        if (scene.output.vtu)
          observers.push_back(
            std::make_unique<report::VtuSeries>(directory.path(), scene.output.stress));
      }

      std::vector<adapt::Observer *>
      list() const
      {
        std::vector<adapt::Observer *> pointers;
        for (const auto &observer : observers)
          pointers.push_back(observer.get());
        return pointers;
      }

      /** Puts an error in log.txt; the terminal gets it from the caller. */
      void
      log_failure(const std::string &message)
      {
        terminal.reset();
        log.error(message);
      }

      void
      close_log()
      {
        log_file.close();
      }

      std::string
      files_to_look_at() const
      {
        return directory.files_to_look_at();
      }

      std::string
      files_in_short() const
      {
        return directory.files_in_short();
      }

    private:
      core::Log                                    &log;
      std::unique_ptr<report::TerminalSink>         terminal;
      report::OutputDirectory                       directory;
      report::LogFile                               log_file;
      std::vector<std::unique_ptr<adapt::Observer>> observers;
    };

    void
    announce_start(const scene::Scene &scene,
                   const scene::Plan  &plan,
                   const RunOptions   &options,
                   MPI_Comm            communicator,
                   const core::Log    &log)
    {
      const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
      log.detail(options.command_line);
      log.info((scene.title.empty() ? scene.name : scene.title) + " (" + scene.file + ")"
               + (n_ranks > 1 ? ", " + std::to_string(n_ranks) + " MPI ranks" : ""));
      for (const auto &warning : scene.warnings())
        log.warning(warning);
      log.detail(plan.text());
    }
  } // namespace

  void
  run_scene(const scene::Scene                   &scene,
            const std::string                    &effective_parameters,
            const RunOptions                     &options,
            MPI_Comm                              communicator,
            const std::vector<adapt::Observer *> &more)
  {
    core::Log                 log;
    core::StageTimer          timer;
    const scene::Plan         plan(scene);
    std::unique_ptr<Watchers> watchers;
    const bool                first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    core::on_first_rank(communicator, [&]() {
      watchers = std::make_unique<Watchers>(scene, effective_parameters, options, log);
    });
    announce_start(scene, plan, options, communicator, log);
    try
      {
        std::vector<adapt::Observer *> observers;
        if (first)
          {
            observers = watchers->list();
            observers.insert(observers.end(), more.begin(), more.end());
          }
        adapt::Driver(scene, plan, communicator, log, timer, observers, report::mesh_line).run();
      }
    catch (const std::exception &error)
      {
        // For log.txt; the caller prints it on the terminal.
        if (first)
          watchers->log_failure(scene.with_place(error.what()));
        throw;
      }
    log.detail(timer.table());
    if (first)
      {
        watchers->close_log();
        log.detail(watchers->files_to_look_at());
        log.info(watchers->files_in_short());
      }
  }
} // namespace tetradapt::cli
