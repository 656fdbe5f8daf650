// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/study_tables.h"

#include "tetradapt/core/printable.h"
#include "tetradapt/report/convergence_table.h"
#include "tetradapt/report/plots.h"
#include "tetradapt/report/record_columns.h"

#include <algorithm>

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
    using Rows = std::vector<std::vector<std::string>>;

    std::size_t
    width_of(const Rows &rows)
    {
      const std::string table = report::aligned_table(rows, 2);
      return table.find('\n');
    }

    /** Leaves out columns without figures, then the less important ones, then cuts the names
     * of the runs, until @p rows fit. */
    void
    make_narrower(const std::size_t most_characters, Rows &rows)
    {
      const auto erase = [&](const std::size_t column) {
        for (auto &row : rows)
          row.erase(row.begin() + column);
      };
      for (std::size_t column = rows[0].size(); column-- > 2;)
        if (std::all_of(rows.begin() + 1, rows.end(), [&](const auto &row) {
              return row[column] == "-";
            }))
          erase(column);
      for (const std::string name : {"cycles", "effect.", "mean REN", "estimate", "seconds"})
        if (width_of(rows) > most_characters)
          {
            const auto found = std::find(rows[0].begin(), rows[0].end(), name);
            if (found != rows[0].end())
              erase(found - rows[0].begin());
          }
      while (width_of(rows) > most_characters)
        {
          const auto longest = std::max_element(rows.begin(), rows.end(), [](auto &a, auto &b) {
            return a[1].size() < b[1].size();
          });
          if ((*longest)[1].size() < 8)
            break;
          std::string &text = (*longest)[1];
          while ((text.back() & 0xC0) == 0x80) // the rest of a character of UTF-8
            text.pop_back();
          text.pop_back();
        }
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
  text_study(const std::vector<StudyRun>     &runs,
             const std::vector<StudyOutcome> &outcomes,
             const unsigned int               most_characters)
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
    if (most_characters > 0)
      make_narrower(most_characters, rows);
    return core::printable(report::aligned_table(rows, 2));
  }
} // namespace tetradapt::cli
