// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/study_tables.h"

#include "tetradapt/report/convergence_table.h"
#include "tetradapt/report/plots.h"
#include "tetradapt/report/record_columns.h"

namespace tetradapt::cli
{
  namespace
  {
    std::vector<adapt::CycleRecord>
    all_records(const std::vector<StudyOutcome> &outcomes)
    {
      std::vector<adapt::CycleRecord> all;
      for (const StudyOutcome &outcome : outcomes)
        all.insert(all.end(), outcome.records.begin(), outcome.records.end());
      return all;
    }

    const adapt::CycleRecord *
    last_accepted(const std::vector<adapt::CycleRecord> &records)
    {
      for (auto record = records.rbegin(); record != records.rend(); ++record)
        if (record->acceptance == adapt::Acceptance::accepted)
          return &*record;
      return nullptr;
    }
  } // namespace

  std::string
  csv_study(const scene::Scene              &study,
            const std::vector<StudyRun>     &runs,
            const std::vector<StudyOutcome> &outcomes)
  {
    const auto  columns = report::record_columns(all_records(outcomes));
    std::string text    = "run";
    for (const auto &variation : study.variations)
      {
        text += "," + report::csv_text(variation.name);
        for (const std::string &parameter : variation.parameters)
          text += "," + report::csv_text(parameter);
      }
    text += "," + report::csv_heading(columns) + "\n";
    for (std::size_t i = 0; i < runs.size(); ++i)
      {
        std::string start = runs[i].name;
        for (std::size_t v = 0; v < study.variations.size(); ++v)
          {
            start += "," + report::csv_text(case_label(study.variations[v], runs[i].cases[v]));
            for (const std::string &value : study.variations[v].cases[runs[i].cases[v]])
              start += "," + report::csv_text(value);
          }
        for (const adapt::CycleRecord &record : outcomes[i].records)
          text += start + "," + report::csv_row(columns, record) + "\n";
      }
    return text;
  }

  std::string
  text_study(const std::vector<StudyRun> &runs, const std::vector<StudyOutcome> &outcomes)
  {
    using report::format_number;
    const auto cell = [](const std::optional<double> &value) {
      return value ? format_number(*value, 4) : std::string("-");
    };
    std::vector<std::vector<std::string>> rows{{"run",
                                                "what",
                                                "cycles",
                                                "tets",
                                                "dofs",
                                                "rel error",
                                                "estimate",
                                                "mean REN",
                                                "effect.",
                                                "seconds",
                                                "outcome"}};
    for (std::size_t i = 0; i < runs.size(); ++i)
      {
        const auto &records = outcomes[i].records;
        double      seconds = 0.;
        for (const auto &record : records)
          seconds += record.seconds_total;
        rows.push_back({runs[i].name.substr(0, runs[i].name.find('-')),
                        runs[i].label,
                        std::to_string(records.size())});
        const adapt::CycleRecord *last = last_accepted(records);
        if (last == nullptr)
          rows.back().insert(rows.back().end(), 7, "-");
        else
          for (const std::string &text : {std::to_string(last->tets),
                                          std::to_string(last->dofs),
                                          cell(last->relative_energy_error),
                                          cell(last->relative_estimate),
                                          cell(last->mean_ren),
                                          cell(report::main_effectivity(*last)),
                                          report::format_fixed(seconds, 2)})
            rows.back().push_back(text);
        rows.back().push_back(outcomes[i].is_failed ? "failed"
                              : outcomes[i].is_done ? "done"
                                                    : "not yet");
      }
    return report::aligned_table(rows, 2);
  }
} // namespace tetradapt::cli
