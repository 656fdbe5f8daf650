// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/run_study.h"

#include "tetradapt/cli/check_inputs.h"
#include "tetradapt/cli/outcome.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/on_first_rank.h"
#include "tetradapt/core/printable.h"
#include "tetradapt/report/log_sinks.h"
#include "tetradapt/report/output_directory.h"
#include "tetradapt/report/plots.h"
#include "tetradapt/scene/parameter_printer.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <set>

namespace tetradapt::cli
{
  namespace
  {
    /** Keeps the records of a run, also of one that fails later. */
    class RecordKeeper : public adapt::Observer
    {
    public:
      explicit RecordKeeper(std::vector<adapt::CycleRecord> &records) : records(records)
      {
      }

      void
      cycle_done(const adapt::CycleEvent &event) override
      {
        records.push_back(event.record);
      }

    private:
      std::vector<adapt::CycleRecord> &records;
    };

    /** The values that decide what check_inputs() finds. */
    std::string
    input_key(const scene::Scene &study, const StudyRun &run)
    {
      std::string key;
      for (std::size_t i = 0; i < study.variations.size(); ++i)
        for (std::size_t j = 0; j < study.variations[i].parameters.size(); ++j)
          {
            const std::string &name = study.variations[i].parameters[j];
            for (const char *section : {"Mesh/", "Materials/", "Supports/", "Loads/", "Reference/"})
              if (name.compare(0, std::string(section).size(), section) == 0)
                key += name + "=" + study.variations[i].cases[run.cases[i]][j] + "\n";
          }
      return key;
    }

    /** What tells the runs of a plot apart, where that is more than one thing. */
    std::string
    plot_key(const scene::Scene &study)
    {
      std::string lines;
      for (std::size_t v = 1; v < study.variations.size(); ++v)
        lines += (v == 1 ? "" : ", ") + study.variations[v].name;
      return lines.empty() ? "" : "colour: " + study.variations[0].name + ", line: " + lines;
    }

    std::vector<report::PlottedRun>
    plotted(const std::vector<StudyRun> &runs, const std::vector<StudyOutcome> &outcomes)
    {
      std::vector<report::PlottedRun> result;
      for (std::size_t i = 0; i < runs.size(); ++i)
        {
          // The first variation tells itself by colour, the others by the kind of line.
          unsigned int pattern = 0;
          for (std::size_t v = 1; v < runs[i].cases.size(); ++v)
            pattern = pattern * (1 + runs.back().cases[v]) + runs[i].cases[v];
          // Two colours that are the same get different lines.
          pattern += runs[i].cases.front() / report::n_plot_colours;
          report::PlottedRun run;
          run.label   = runs[i].label;
          run.degree  = runs[i].scene.degree;
          run.colour  = runs[i].cases.front();
          run.pattern = pattern;
          run.records = outcomes[i].records;
          result.push_back(std::move(run));
        }
      return result;
    }

    bool
    has_records(const std::vector<StudyOutcome> &outcomes)
    {
      return std::any_of(outcomes.begin(), outcomes.end(), [](const StudyOutcome &outcome) {
        return !outcome.records.empty();
      });
    }

    /** Results of an earlier study make way when this one has a cycle to show. */
    void
    write_tables(const scene::Scene              &study,
                 report::OutputDirectory         &directory,
                 const std::vector<StudyRun>     &runs,
                 const std::vector<StudyOutcome> &outcomes)
    {
      if (!has_records(outcomes))
        return;
      directory.begin();
      if (!study.output.tables)
        return;
      directory.files().write("study.csv", csv_study(study, runs, outcomes));
      directory.files().write("study.txt", text_study(runs, outcomes));
    }

    void
    finish(const scene::Scene              &study,
           report::OutputDirectory         &directory,
           const RunOptions                &options,
           const std::vector<StudyRun>     &runs,
           const std::vector<StudyOutcome> &outcomes)
    {
      core::Log                  log;
      const report::TerminalSink terminal(log,
                                          std::cerr,
                                          report::TerminalSink::stderr_options(options.quiet));
      if (!options.quiet)
        {
          std::cout << "\n" << text_study(runs, outcomes, 80) << std::flush;
          require_written(std::cout);
        }
      if (!has_records(outcomes))
        return;
      if (study.output.plots)
        report::draw_study(directory.files(),
                           study.title.empty() ? study.name : study.title,
                           plotted(runs, outcomes),
                           plot_key(study),
                           log);
      directory.end();
      log.info(report::OutputDirectory::study_files_in_short(directory.path()));
    }
  } // namespace

  void
  check_study_inputs(const scene::Scene          &study,
                     const std::vector<StudyRun> &runs,
                     scene::Mistakes             &mistakes,
                     const core::Log             &log)
  {
    std::set<std::string> checked;
    for (const StudyRun &run : runs)
      if (checked.insert(input_key(study, run)).second)
        {
          scene::Mistakes found;
          check_inputs(run.scene, found, log);
          mistakes.merge(found, [&](const auto &message) {
            return run.scene.with_place(message) + " (in the run '" + run.label + "' of the study)";
          });
        }
  }

  int
  run_study(const scene::Scene          &study,
            const std::vector<StudyRun> &runs,
            const RunOptions            &options,
            MPI_Comm                     communicator,
            MPI_Comm                     control)
  {
    std::unique_ptr<report::OutputDirectory> directory; // on the first rank
    core::on_first_rank(communicator, [&] {
      scene::Mistakes mistakes;
      check_study_inputs(study, runs, mistakes, core::Log());
      mistakes.throw_if_any(study.file);
      std::vector<const scene::Scene *> scenes;
      for (const StudyRun &run : runs)
        scenes.push_back(&run.scene);
      directory = std::make_unique<report::OutputDirectory>(study,
                                                            scene::effective_parameters(study),
                                                            scenes);
    });
    const bool first  = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    const bool spoken = first && !options.quiet;
    int        worst  = Outcome::done;

    // What each run says at length is in its own log.txt.
    RunOptions run_options = options;
    run_options.brief      = !options.verbose;
    std::vector<StudyOutcome> outcomes(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i)
      {
        if (spoken)
          std::cout << (i == 0 ? "" : "\n") << "Run " << i + 1 << " of " << runs.size() << ": "
                    << core::printable(runs[i].label) << std::endl;
        RecordKeeper keeper(outcomes[i].records);
        Outcome      outcome = attempt([&] {
          run_scene(runs[i].scene,
                    scene::effective_parameters(runs[i].scene),
                    run_options,
                    communicator,
                    {&keeper});
        });
        if (outcome.code != Outcome::done)
          outcome.message
            = runs[i].scene.with_place(outcome.message) + " (run " + runs[i].name + ")";
        const int code        = conclude(outcome, control);
        outcomes[i].is_done   = true;
        outcomes[i].is_failed = code != Outcome::done;
        worst                 = std::max(worst, code);
        core::on_first_rank(communicator, [&] { write_tables(study, *directory, runs, outcomes); });
      }
    core::on_first_rank(communicator, [&] { finish(study, *directory, options, runs, outcomes); });
    return worst;
  }
} // namespace tetradapt::cli
