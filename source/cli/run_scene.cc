// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/run_scene.h"

#include "tetradapt/adapt/driver.h"
#include "tetradapt/cli/outcome.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/on_first_rank.h"
#include "tetradapt/core/printable.h"
#include "tetradapt/report/answer.h"
#include "tetradapt/report/convergence_table.h"
#include "tetradapt/report/log_sinks.h"
#include "tetradapt/report/mesh_report.h"
#include "tetradapt/report/mesh_summary.h"
#include "tetradapt/report/output_directory.h"
#include "tetradapt/report/plots.h"
#include "tetradapt/report/reactions.h"
#include "tetradapt/report/results.h"
#include "tetradapt/report/size_field_file.h"
#include "tetradapt/report/vtu_series.h"
#include "tetradapt/scene/plan.h"

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <atomic>
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

    /** What watches a run on the first rank. As an observer it hands on what it is told to
     * those that write the results: when the first cycle is done, results of earlier runs
     * make way, and no interruption falls between files that belong together. */
    class Watchers : public adapt::Observer
    {
    public:
      Watchers(const scene::Scene                   &scene,
               const std::string                    &effective_parameters,
               const RunOptions                     &options,
               const std::vector<adapt::Observer *> &more,
               core::Log                            &log)
        : options(options), log(log),
          terminal(std::make_unique<report::TerminalSink>(log, std::cerr, sink_options(options))),
          directory(scene, effective_parameters), log_file(log, directory.log_path()), more(more)
      {
        if (!directory.files().lock_problem().empty())
          log.warning("The folder '" + directory.path() + "' cannot be locked ("
                      + directory.files().lock_problem()
                      + "): take care that no other run writes to it.");
        report::ResultFolder *tables = scene.output.tables ? &directory.files() : nullptr;
        std::ostream         *rows   = options.quiet ? nullptr : &std::cout;
        if (rows != nullptr || scene.output.tables)
          observers.push_back(std::make_unique<report::ConvergenceTable>(tables, rows, log));
        observers.push_back(std::make_unique<report::MeshReport>(tables, log));
        observers.push_back(std::make_unique<report::ResultsSummary>(tables, log));
        if (tables != nullptr)
          observers.push_back(std::make_unique<report::ReactionsTable>(*tables));
        if (scene.output.plots)
          observers.push_back(std::make_unique<report::RunPlots>(directory.files(), log));
        if (scene.output.size_field)
          observers.push_back(std::make_unique<report::SizeFieldFile>(directory.files()));
        if (scene.output.vtu)
          observers.push_back(
            std::make_unique<report::VtuSeries>(directory.files(), scene.output.stress));
        if (options.interrupts != nullptr)
          options.interrupts->set_action([this](const int signal) { end_at_once(signal); });
      }

      ~Watchers() override
      {
        if (options.interrupts != nullptr)
          options.interrupts->set_action({});
        close_anyhow(); // if nobody did: a library threw something that is no exception
      }

      void
      run_started(const scene::Scene &scene) override
      {
        tell([&](adapt::Observer &observer) { observer.run_started(scene); });
      }

      void
      cycle_done(const adapt::CycleEvent &event) override
      {
        const auto whole = uninterrupted();
        directory.begin();
        tell([&](adapt::Observer &observer) { observer.cycle_done(event); });
        n_cycles = event.record.cycle + 1;
        check_output();
      }

      void
      run_done(const adapt::StopDecision &decision) override
      {
        const auto whole = uninterrupted();
        tell([&](adapt::Observer &observer) { observer.run_done(decision); });
      }

      /** Puts an error in the log and closes it; the terminal gets the error from the
       * caller. */
      void
      fail(const std::string &message)
      {
        const auto        whole = uninterrupted();
        const std::string kept  = directory.kept_results();
        if (!kept.empty())
          log.info(kept);
        terminal.reset();
        log.error(message);
        close_anyhow();
      }

      /** Says where the files are and gives the run's answer, its last lines: in the log,
       * which is closed, and on the terminal. */
      void
      finish()
      {
        log.detail(directory.files_to_look_at());
        log.info(directory.files_in_short());
        terminal.reset();
        log.info(answer.text());
        {
          const auto whole = uninterrupted();
          close();
        }
        if (!options.quiet && !options.brief)
          std::cout << '\n' << core::printable(answer.text()) << std::flush;
        check_output();
      }

    private:
      std::unique_lock<std::timed_mutex>
      uninterrupted() const
      {
        return options.interrupts == nullptr ? std::unique_lock<std::timed_mutex>()
                                             : options.interrupts->defer();
      }

      template <typename Action>
      void
      tell(const Action &action)
      {
        for (const auto &observer : observers)
          action(*observer);
        action(answer);
        for (adapt::Observer *observer : more)
          action(*observer);
      }

      void
      check_output()
      {
        log_file.check();
        if (!options.quiet)
          require_written(std::cout);
        if (!std::cerr)
          throw core::NumericalError("Cannot write to the standard error output.");
      }

      /** What was the matter before is the error to tell. */
      void
      close_anyhow()
      {
        try
          {
            close();
          }
        catch (const std::exception &)
          {
          }
      }

      void
      close()
      {
        directory.end();
        log_file.close();
        directory.files().finish();
      }

      /** Runs in a thread of its own when a signal ends the program. */
      void
      end_at_once(const int signal)
      {
        const std::string kept = directory.kept_results();
        const std::string text
          = "Ended by " + core::InterruptWatcher::signal_name(signal) + " after "
            + std::to_string(n_cycles) + (n_cycles == 1 ? " cycle. " : " cycles. ")
            + (kept.empty() ? "What there is lies in '" + directory.path() + "'." : kept + ".");
        log_file.close_with(text);
        directory.end();
        directory.files().end_at_once();
        const std::string line = (sink_options(options).is_terminal ? "\r\033[K" : "")
                                 + core::printable("Error: " + text) + "\n";
        if (::write(STDERR_FILENO, line.data(), line.size()) < 0)
          return; // nobody is there to be told
      }

      const RunOptions                              options;
      core::Log                                    &log;
      std::unique_ptr<report::TerminalSink>         terminal;
      report::OutputDirectory                       directory;
      report::LogFile                               log_file;
      std::vector<std::unique_ptr<adapt::Observer>> observers;
      report::Answer                                answer;
      std::vector<adapt::Observer *>                more;
      std::atomic<unsigned int>                     n_cycles{0};
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
      watchers = std::make_unique<Watchers>(scene, effective_parameters, options, more, log);
    });
    announce_start(scene, plan, options, communicator, log);
    try
      {
        std::vector<adapt::Observer *> observers;
        if (first)
          observers.push_back(watchers.get());
        adapt::Driver(scene, plan, communicator, log, timer, observers, report::mesh_line).run();
        log.detail(timer.table());
        core::on_first_rank(communicator, [&]() { watchers->finish(); });
      }
    catch (const std::exception &error)
      {
        // It may have failed because a child process got the signal also.
        if (options.interrupts != nullptr)
          options.interrupts->wait_if_ending();
        if (first)
          watchers->fail(scene.with_place(error.what()));
        throw;
      }
  }
} // namespace tetradapt::cli
