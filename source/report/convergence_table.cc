// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/convergence_table.h"

#include "tetradapt/core/atomic_file.h"
#include "tetradapt/report/record_columns.h"

#include <algorithm>
#include <ostream>

namespace tetradapt::report
{
  namespace
  {
    /** The cell of a table; @p missing where there is no figure. */
    std::string
    format_cell(const RecordColumn       &column,
                const adapt::CycleRecord &record,
                const unsigned int        digits,
                const int                 decimals_of_seconds,
                const std::string        &missing)
    {
      const std::optional<double> value = column.value(record);
      if (!value)
        return missing;
      if (column.kind == RecordColumn::Kind::count)
        return format_fixed(*value, 0);
      if (column.kind == RecordColumn::Kind::seconds && decimals_of_seconds >= 0)
        return format_fixed(*value, decimals_of_seconds);
      return format_number(*value, digits);
    }

    /** Right-aligned; a text that is too long keeps one blank before it. */
    void
    append_aligned(std::string &line, const std::string &text, const std::size_t width)
    {
      if (!line.empty())
        line += ' ';
      line.append(width - std::min(width, text.size()), ' ');
      line += text;
    }
  } // namespace

  std::string
  csv_table(const std::vector<adapt::CycleRecord> &records)
  {
    const auto &columns = record_columns();

    std::string text;
    for (const RecordColumn &column : columns)
      text += (text.empty() ? "" : ",") + std::string(column.name);
    text += '\n';
    for (const adapt::CycleRecord &record : records)
      {
        std::string line;
        for (const RecordColumn &column : columns)
          line
            += (&column == &columns.front() ? "" : ",") + format_cell(column, record, 10, -1, "");
        text += line + '\n';
      }
    return text;
  }

  std::string
  text_table(const std::vector<adapt::CycleRecord> &records)
  {
    std::vector<std::string> lines(records.size() + 1);
    for (const RecordColumn &column : record_columns())
      {
        if (std::none_of(records.begin(), records.end(), [&](const adapt::CycleRecord &record) {
              return column.value(record).has_value();
            }))
          continue;
        std::vector<std::string> cells{column.name};
        for (const adapt::CycleRecord &record : records)
          cells.push_back(format_cell(column, record, 7, 3, "-"));
        std::size_t width = 0;
        for (const std::string &cell : cells)
          width = std::max(width, cell.size());
        for (unsigned int i = 0; i < lines.size(); ++i)
          append_aligned(lines[i], cells[i], width);
      }
    std::string text;
    for (const std::string &line : lines)
      text += line + '\n';
    return text;
  }

  std::string
  terminal_heading()
  {
    std::string line;
    for (const RecordColumn &column : record_columns())
      if (column.heading != nullptr)
        append_aligned(line, column.heading, column.width);
    return line;
  }

  std::string
  terminal_row(const adapt::CycleRecord &record)
  {
    std::string line;
    for (const RecordColumn &column : record_columns())
      if (column.heading != nullptr)
        append_aligned(line,
                       format_cell(column, record, column.width >= 11 ? 6 : 4, 2, "-"),
                       column.width);
    return line;
  }

  ConvergenceTable::ConvergenceTable(const std::string &directory,
                                     std::ostream      *terminal,
                                     const core::Log   &log)
    : directory(directory), terminal(terminal), log(log)
  {
  }

  void
  ConvergenceTable::run_started(const scene::Scene &)
  {
    rows.clear();
  }

  void
  ConvergenceTable::cycle_done(const adapt::CycleEvent &event)
  {
    rows.push_back(event.record);
    if (terminal != nullptr)
      {
        log.progress("");
        if (rows.size() == 1)
          *terminal << terminal_heading() << '\n';
        *terminal << terminal_row(rows.back()) << std::endl;
      }
    if (!directory.empty())
      {
        core::write_file(directory + "/convergence.csv", csv_table(rows));
        core::write_file(directory + "/convergence.txt", text_table(rows));
      }
  }
} // namespace tetradapt::report
