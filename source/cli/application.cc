// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/application.h"

#include "tetradapt/cli/check_inputs.h"
#include "tetradapt/cli/load_scene.h"
#include "tetradapt/cli/outcome.h"
#include "tetradapt/cli/preview.h"
#include "tetradapt/cli/run_scene.h"
#include "tetradapt/cli/run_study.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/interrupt_watcher.h"
#include "tetradapt/core/printable.h"
#include "tetradapt/report/log_sinks.h"
#include "tetradapt/report/output_directory.h"
#include "tetradapt/scene/plan.h"

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>
#include <thread>

namespace tetradapt::cli
{
  namespace
  {
    /** Whether something like mpirun started this process, and as which rank;
     * known without starting MPI. */
    struct Launch
    {
      bool by_launcher = false;
      bool first       = true;
    };

    Launch
    find_launch()
    {
      Launch launch;
      for (const char *name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "PMI_ID"})
        if (const char *rank = std::getenv(name))
          {
            launch.by_launcher = true;
            launch.first       = std::string(rank) == "0";
            return launch;
          }
      for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"})
        launch.by_launcher = launch.by_launcher || std::getenv(name) != nullptr;
      return launch;
    }

    /** Tells Open MPI that there is one process, which halves the time it takes to
     * start: it need not even fork a daemon of its own. What the user set stays. */
    void
    prepare_single_process()
    {
      setenv("OMPI_MCA_btl", "self", 0);
      setenv("OMPI_MCA_pml", "ob1", 0);
      setenv("OMPI_MCA_plm", "isolated", 0);
      setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
      // Processes that start at the same time remove each other's session folders, and die.
      setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
    }

    std::string
    quoted(const std::string &argument)
    {
      if (!argument.empty() && argument.find_first_of(" \t;*?<>|&()$'\"\\") == std::string::npos)
        return argument;
      std::string text = "'";
      for (const char c : argument)
        text += c == '\'' ? std::string("'\\''") : std::string(1, c);
      return text + "'";
    }

    std::string
    output_folder(const scene::Scene &scene)
    {
      const std::string name
        = scene.output.directory.empty() ? "output/" + scene.name : scene.output.directory;
      std::error_code   error;
      const std::string whole = std::filesystem::weakly_canonical(name, error).string();
      return error ? name : whole; // what is wrong with it, is said when it is made
    }

    /** The plan of a scene; of a study the names of its runs and the plan of the first. */
    std::string
    plan_text(const scene::Scene &scene, const std::vector<StudyRun> &runs)
    {
      if (runs.empty())
        return scene::Plan(scene).text();
      std::string text = "a study of " + std::to_string(runs.size()) + " runs:\n";
      for (const StudyRun &run : runs)
        text += "  " + run.name + "\n";
      return text + "the first one\n" + scene::Plan(runs.front().scene).text();
    }

    int
    validate(const Options &options, const bool print)
    {
      int worst = Outcome::done;
      for (const auto &file : options.scenes)
        {
          const Outcome outcome = attempt([&] {
            const scene::Scene          scene = load_scene(file, options);
            const std::vector<StudyRun> runs
              = scene.variations.empty() ? std::vector<StudyRun>() : load_study(scene, options);
            if (!print)
              return;
            core::Log                  log;
            const report::TerminalSink terminal(log, std::cerr, {});
            scene::Mistakes            mistakes;
            if (runs.empty())
              {
                scene::Mistakes found;
                check_inputs(scene, found, log);
                mistakes.merge(found,
                               [&](const auto &message) { return scene.with_place(message); });
              }
            else
              check_study_inputs(scene, runs, mistakes, log);
            mistakes.throw_if_any(file);
            for (const auto &warning : scene.warnings())
              std::cerr << core::printable("Warning: " + warning) << '\n';
            if (!options.quiet)
              std::cerr << core::printable(file + ": valid\n" + plan_text(scene, runs));
          });
          if (outcome.code != Outcome::done && print)
            print_error(outcome.message);
          worst = std::max(worst, outcome.code);
        }
      return worst;
    }

    /** Runs a scene or a study; returns the largest code of a study's runs. */
    int
    compute(const scene::Scene &scene,
            const Options      &options,
            const RunOptions   &run_options,
            MPI_Comm            control)
    {
      try
        {
          if (!scene.variations.empty())
            return run_study(
              scene, load_study(scene, options), run_options, MPI_COMM_WORLD, control);
          run_scene(scene, scene::effective_parameters(scene), run_options, MPI_COMM_WORLD);
          return Outcome::done;
        }
      catch (const core::InputError &error)
        {
          throw core::InputError(scene.with_place(error.what()));
        }
    }

    /** A descriptor that is closed would be given to the next file that is opened, which
     * would get what is printed. What is written to standard output then fails. */
    void
    occupy_standard_descriptors()
    {
      for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)
          {
            const int opened
              = ::open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);
            if (opened >= 0 && opened != descriptor)
              {
                ::dup2(opened, descriptor);
                ::close(opened);
              }
          }
    }

    /** Writing to a closed pipe or beyond a limit shall fail, not kill. */
    void
    ignore_write_signals()
    {
      std::signal(SIGPIPE, SIG_IGN);
      std::signal(SIGXFSZ, SIG_IGN);
    }

    /** What is done when a signal ends the program between two runs, or on a rank that
     * writes nothing: such a one lets the first close its log before mpirun ends all. */
    void
    end_by_signal(const int signal)
    {
      const std::string text
        = "Error: Ended by " + core::InterruptWatcher::signal_name(signal) + ".\n";
      if (!find_launch().first)
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
      else if (::write(STDERR_FILENO, text.data(), text.size()) < 0)
        return; // nobody is there to be told
    }

    /** Prints what an option asks for; returns the exit code. */
    int
    print(const std::string &text, const bool is_first)
    {
      if (!is_first)
        return Outcome::done;
      const Outcome outcome = attempt([&] {
        std::cout << text;
        require_written(std::cout);
      });
      if (outcome.code != Outcome::done)
        print_error(outcome.message);
      return outcome.code;
    }

    /** Shows where a scene, or the first run of a study, acts. */
    void
    preview_file(const std::string &file, const Options &options)
    {
      const scene::Scene scene     = load_scene(file, options);
      const auto         directory = report::OutputDirectory::path_of(scene);
      try
        {
          if (scene.variations.empty())
            preview(scene, directory, options.quiet, MPI_COMM_WORLD);
          else
            preview(load_study(scene, options).front().scene,
                    directory,
                    options.quiet,
                    MPI_COMM_WORLD);
        }
      catch (const core::InputError &error)
        {
          throw core::InputError(scene.with_place(error.what()));
        }
    }

    int
    preview_all(const Options &options)
    {
      MPI_Comm control;
      MPI_Comm_dup(MPI_COMM_WORLD, &control);
      int worst = Outcome::done;
      for (const auto &file : options.scenes)
        worst = std::max(worst, conclude(attempt([&] { preview_file(file, options); }), control));
      MPI_Comm_free(&control);
      return worst;
    }

    int
    run(const Options &options, const RunOptions &run_options)
    {
      // Agreeing on an outcome must not meet the collective calls of a run.
      MPI_Comm control;
      MPI_Comm_dup(MPI_COMM_WORLD, &control);
      int                   worst = Outcome::done;
      std::set<std::string> folders;
      for (const auto &file : options.scenes)
        {
          scene::Scene scene;
          int          code = conclude(attempt([&] {
                                scene = load_scene(file, options);
                                if (!folders.insert(output_folder(scene)).second)
                                  throw core::InputError(
                                    file
                                    + ": its results would replace those of an earlier "
                                               "scene of this run, in "
                                    + output_folder(scene)
                                    + ". Set another Output/Directory, or rename the scene.");
                              }),
                              control);
          if (code == Outcome::done)
            code = conclude(attempt([&] {
                              worst
                                = std::max(worst, compute(scene, options, run_options, control));
                            }),
                            control);
          worst = std::max(worst, code);
        }
      MPI_Comm_free(&control);
      return worst;
    }
  } // namespace

  int
  run_application(int argc, char **argv)
  {
    occupy_standard_descriptors();
    ignore_write_signals();
    const Launch launch = find_launch();
    Options      options;
    // Other ranks would only repeat what the first one says.
    const Outcome parsed
      = attempt([&] { options = parse_options(std::vector<std::string>(argv + 1, argv + argc)); });
    if (parsed.code != Outcome::done)
      {
        if (launch.first)
          print_error(parsed.message);
        return parsed.code;
      }
    switch (options.action)
      {
      case Options::Action::help:
        return print(help_text(), launch.first);
      case Options::Action::version:
        return print(version_text(), launch.first);
      case Options::Action::print_parameters:
        {
          std::ostringstream text;
          scene::print_parameters(text, options.format);
          return print(text.str(), launch.first);
        }
      case Options::Action::validate:
        return validate(options, launch.first);
      case Options::Action::preview:
      case Options::Action::run:
        break;
      }
    RunOptions run_options;
    run_options.quiet   = options.quiet;
    run_options.verbose = options.verbose;
    for (int i = 0; i < argc; ++i)
      run_options.command_line += (i == 0 ? "" : " ") + quoted(argv[i]);
    if (!launch.by_launcher)
      prepare_single_process();
    // The name only: PETSc, which deal.II may start with MPI, would call every option
    // of ours a spelling mistake.
    int                                            n_names = 1;
    char                                          *names[] = {argv[0], nullptr};
    char                                         **first   = names;
    const dealii::Utilities::MPI::MPI_InitFinalize mpi(n_names, first, 1);
    ignore_write_signals(); // some library that MPI starts undoes it
    core::InterruptWatcher interrupts(end_by_signal);
    run_options.interrupts = &interrupts;
    return options.action == Options::Action::preview ? preview_all(options)
                                                      : run(options, run_options);
  }
} // namespace tetradapt::cli
