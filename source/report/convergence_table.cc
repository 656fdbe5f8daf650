// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/convergence_table.h"

#include "tetradapt/core/printable.h"

#include <algorithm>
#include <ostream>

namespace tetradapt::report
{
  namespace
  {
    /** Right-aligned; a text that is too long keeps one blank before it. */
    void
    append_aligned(std::string &line, const std::string &text, const std::size_t width)
    {
      if (!line.empty())
        line += ' ';
      line.append(width - std::min(width, text.size()), ' ');
      line += text;
    }

    using Records = std::vector<adapt::CycleRecord>;

    /** The terminal's heading is repeated after so many rows. */
    constexpr unsigned int rows_a_heading = 20;

    bool
    has_value(const RecordColumn &column, const Records &records)
    {
      return std::any_of(records.begin(), records.end(), [&](const adapt::CycleRecord &record) {
        return column.has_value(record);
      });
    }

    /** The table of the columns of one part that are not empty. */
    std::string
    part_table(const std::string               &part,
               const std::vector<RecordColumn> &columns,
               const Records                   &records)
    {
      std::vector<std::vector<std::string>> rows(records.size() + 1);
      for (const RecordColumn &column : columns)
        {
          const bool first = &column == &columns.front(); // the cycle's number, in every part
          if (!(first || column.part == part) || !has_value(column, records))
            continue;
          rows[0].push_back(column.name);
          for (std::size_t i = 0; i < records.size(); ++i)
            rows[i + 1].push_back(column.cell(records[i], 7, 3, "-"));
        }
      return aligned_table(rows);
    }
  } // namespace

  std::string
  csv_heading(const std::vector<RecordColumn> &columns)
  {
    std::string line;
    for (const RecordColumn &column : columns)
      line += (line.empty() ? "" : ",") + csv_text(column.name);
    return line;
  }

  std::string
  csv_row(const std::vector<RecordColumn> &columns, const adapt::CycleRecord &record)
  {
    std::string line;
    for (const RecordColumn &column : columns)
      line += (&column == &columns.front() ? "" : ",") + csv_text(column.cell(record, 10, -1, ""));
    return line;
  }

  std::string
  csv_table(const std::vector<adapt::CycleRecord> &records)
  {
    const auto  columns = record_columns(records);
    std::string text    = csv_heading(columns) + '\n';
    for (const adapt::CycleRecord &record : records)
      text += csv_row(columns, record) + '\n';
    return text;
  }

  std::string
  text_table(const std::vector<adapt::CycleRecord> &records)
  {
    const auto               columns = record_columns(records);
    std::vector<std::string> parts;
    for (const RecordColumn &column : columns)
      if (std::find(parts.begin(), parts.end(), column.part) == parts.end())
        parts.push_back(column.part);
    std::string text;
    for (const std::string &part : parts)
      text += (part.empty() ? "" : "\n" + part + "\n") + part_table(part, columns, records);
    return text;
  }

  std::string
  terminal_heading(const std::vector<TerminalColumn> &columns)
  {
    std::string line;
    for (const TerminalColumn &column : columns)
      append_aligned(line, column.heading, column.width);
    return line;
  }

  std::string
  terminal_row(const std::vector<TerminalColumn> &columns, const adapt::CycleRecord &record)
  {
    std::string line;
    for (const TerminalColumn &column : columns)
      append_aligned(line,
                     column.column.cell(record, column.width >= 11 ? 6 : 4, 2, "-"),
                     column.width);
    return line;
  }

  ConvergenceTable::ConvergenceTable(ResultFolder    *folder,
                                     std::ostream    *terminal,
                                     const core::Log &log)
    : folder(folder), terminal(terminal), log(log)
  {
  }

  void
  ConvergenceTable::run_started(const scene::Scene &)
  {
    rows.clear();
    heading.clear();
    rows_below_heading = 0;
  }

  void
  ConvergenceTable::cycle_done(const adapt::CycleEvent &event)
  {
    rows.push_back(event.record);
    if (terminal != nullptr)
      {
        log.progress("");
        // A figure that comes later (an estimator that needs several cycles) gets a column.
        const auto        columns     = terminal_columns(rows);
        const std::string new_heading = terminal_heading(columns);
        if (new_heading != heading || rows_below_heading == rows_a_heading)
          {
            *terminal << core::printable(new_heading) << '\n';
            rows_below_heading = 0;
          }
        ++rows_below_heading;
        heading = new_heading;
        *terminal << terminal_row(columns, rows.back()) << std::endl;
      }
    if (folder != nullptr)
      {
        folder->write("convergence.csv", csv_table(rows));
        folder->write("convergence.txt", text_table(rows));
      }
  }
} // namespace tetradapt::report
