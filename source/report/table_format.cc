// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/printable.h"
#include "tetradapt/report/record_columns.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace tetradapt::report
{
  namespace
  {
    std::string
    format(const double value, const std::chars_format style, const unsigned int precision)
    {
      // Fixed style writes up to 309 digits before the point.
      std::array<char, 400> text;
      const auto            end
        = std::to_chars(text.data(), text.data() + text.size(), value, style, precision).ptr;
      return std::string(text.data(), end);
    }

    /** Characters, not bytes. */
    std::size_t
    length(const std::string &text)
    {
      return std::count_if(text.begin(), text.end(), [](const char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
      });
    }
  } // namespace

  std::string
  format_number(const double value, const unsigned int digits)
  {
    return format(value, std::chars_format::general, digits);
  }

  std::string
  format_fixed(const double value, const unsigned int decimals)
  {
    return format(value, std::chars_format::fixed, decimals);
  }

  std::string
  format_cell(const RecordColumn::Kind     kind,
              const std::optional<double> &value,
              const unsigned int           digits,
              const int                    decimals_of_seconds,
              const std::string           &missing)
  {
    if (!value)
      return missing;
    if (kind == RecordColumn::Kind::count)
      return format_fixed(*value, 0);
    if (kind == RecordColumn::Kind::seconds && decimals_of_seconds >= 0)
      return format_fixed(*value, decimals_of_seconds);
    return format_number(*value, digits);
  }

  bool
  RecordColumn::has_value(const adapt::CycleRecord &record) const
  {
    return kind == Kind::text ? !text(record).empty() : value(record).has_value();
  }

  std::string
  RecordColumn::cell(const adapt::CycleRecord &record,
                     const unsigned int        digits,
                     const int                 decimals_of_seconds,
                     const std::string        &missing) const
  {
    if (kind != Kind::text)
      return format_cell(kind, value(record), digits, decimals_of_seconds, missing);
    const std::string word = text(record);
    return word.empty() ? missing : word;
  }

  std::string
  csv_text(const std::string &given)
  {
    // Spreadsheets take a text that begins so for a formula, and may run what it names. A
    // number is none, whatever its sign.
    double      value;
    const char *end = given.data() + given.size();
    const auto  number
      = std::from_chars(given.data() + (given.compare(0, 1, "+") == 0 ? 1 : 0), end, value);
    const bool is_number  = number.ec == std::errc() && number.ptr == end;
    const bool is_formula = !is_number && !given.empty()
                            && std::string("=+-@\t\r\n").find(given[0]) != std::string::npos;
    const std::string text = (is_formula ? "'" : "") + core::printable(given);
    if (text.find_first_of(",\"\n\r") == std::string::npos)
      return text;
    std::string quoted = "\"";
    for (const char c : text)
      quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
  }

  std::string
  aligned_table(const std::vector<std::vector<std::string>> &rows, const unsigned int n_left)
  {
    std::vector<std::size_t> widths;
    for (const auto &row : rows)
      {
        widths.resize(std::max(widths.size(), row.size()), 0);
        for (std::size_t column = 0; column < row.size(); ++column)
          widths[column] = std::max(widths[column], length(row[column]));
      }
    std::string text;
    for (const auto &row : rows)
      {
        std::string line;
        for (std::size_t column = 0; column < row.size(); ++column)
          {
            const std::string gap(widths[column] - length(row[column]), ' ');
            line += column == 0 ? "" : " ";
            if (column < n_left)
              line += row[column] + (column + 1 == row.size() ? "" : gap);
            else
              line += gap + row[column];
          }
        text += line + '\n';
      }
    return text;
  }
} // namespace tetradapt::report
