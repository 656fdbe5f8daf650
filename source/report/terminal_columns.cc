// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/record_columns.h"

#include <algorithm>

namespace tetradapt::report
{
  namespace
  {
    using Record  = adapt::CycleRecord;
    using Columns = std::vector<RecordColumn>;

    /** Characters of the table's lines. */
    constexpr unsigned int most_characters = 80;

    /** A column that is left out the sooner the larger @p rank is, if the table is too wide. */
    struct RankedColumn
    {
      TerminalColumn column;
      unsigned int   rank = 0;
    };

    /** The column of @p part whose name begins with @p start. */
    const RecordColumn &
    column_of(const Columns &columns, const std::string &part, const std::string &start)
    {
      return *std::find_if(columns.begin(), columns.end(), [&](const RecordColumn &column) {
        return column.part == part && column.name.compare(0, start.size(), start) == 0;
      });
    }

    bool
    is_empty(const RecordColumn &column, const std::vector<Record> &records)
    {
      return std::none_of(records.begin(), records.end(), [&](const Record &record) {
        return column.has_value(record);
      });
    }

    /** Name of the first estimator of the first cycle that has one, which drives if one does;
     * empty if there is none, or if it only repeats the difference to the reference. */
    std::string
    shown_estimator(const std::vector<Record> &records)
    {
      for (const Record &record : records)
        if (!record.estimates.empty())
          return record.estimates.front().which == scene::ErrorEstimator::energy
                     && record.error_source == adapt::ErrorSource::reference
                   ? ""
                   : record.estimates.front().name;
      return "";
    }

    std::string
    first_goal(const std::vector<Record> &records)
    {
      for (const Record &record : records)
        if (!record.goals.empty())
          return record.goals.front().name;
      return "";
    }

    /** The estimate, relative where it is in the energy norm, and its effectivity. */
    void
    add_estimate(const std::vector<Record> &records,
                 const bool                 error_is_true,
                 std::vector<RankedColumn> &columns)
    {
      const std::string name     = shown_estimator(records);
      const Columns     possible = possible_columns({name}, {}, false);
      if (name.empty())
        {
          if (error_is_true)
            columns.push_back(
              {{"ref. diff.", 10, column_of(possible, "", "relative_estimate")}, 1});
          columns.push_back({{"effect.", 7, column_of(possible, "", "effectivity")}, 3});
          return;
        }
      const std::string  part     = "estimator " + name;
      const RecordColumn relative = column_of(possible, part, "relative_estimate_");
      const RecordColumn absolute = column_of(possible, part, "estimate_");
      const std::string  heading  = name.size() > 10 ? "estimate" : "est. " + name;
      columns.push_back({{heading,
                          std::max<unsigned>(9, heading.size()),
                          is_empty(relative, records) ? absolute : relative},
                         1});
      columns.push_back({{"effect.", 7, column_of(possible, part, "effectivity_")}, 3});
    }

    void
    add_goal(const std::vector<Record> &records, std::vector<RankedColumn> &columns)
    {
      const std::string name = first_goal(records);
      if (name.empty())
        return;
      const std::string heading = name.size() > 14 ? "goal value" : name;
      columns.push_back({{heading,
                          std::max<unsigned>(11, heading.size()),
                          column_of(possible_columns({}, {name}, false), "goal " + name, "goal_")},
                         2});
    }
    /** Without the columns of the highest ranks that have no room. */
    std::vector<TerminalColumn>
    narrowed(std::vector<RankedColumn> columns)
    {
      const auto width = [&] {
        unsigned int sum = columns.size() - 1; // a blank between two
        for (const RankedColumn &column : columns)
          sum += column.column.width;
        return sum;
      };
      const auto lower
        = [](const RankedColumn &a, const RankedColumn &b) { return a.rank < b.rank; };
      while (width() > most_characters)
        columns.erase(std::max_element(columns.begin(), columns.end(), lower));
      std::vector<TerminalColumn> result;
      for (const RankedColumn &column : columns)
        result.push_back(column.column);
      return result;
    }
  } // namespace

  std::vector<TerminalColumn>
  terminal_columns(const std::vector<adapt::CycleRecord> &records)
  {
    const Columns fixed    = possible_columns({}, {}, false);
    const auto    named    = [&](const std::string &name) { return column_of(fixed, "", name); };
    const auto    measured = std::find_if(records.begin(), records.end(), [](const Record &r) {
      return r.relative_energy_error.has_value();
    });
    const bool    is_true  = measured != records.end() && adapt::is_true(measured->error_source);
    std::vector<RankedColumn> columns{
      {{"cycle", 5, named("cycle")}, 0},
      {{"points", 8, named("points")}, 9},
      {{"tets", 8, named("tets")}, 0},
      {{"dofs", 9, named("dofs")}, 0},
      {{"mean REN", 9, named("mean_ren")}, 5},
      {{"rel L2", 9, named("relative_l2_error")}, 7},
      {{is_true ? "true err." : "ref. diff.", 10, named("relative_energy_error")}, 0}};
    add_estimate(records, is_true, columns);
    add_goal(records, columns);
    columns.push_back({{"solve s", 7, named("seconds_solve")}, 8});
    columns.push_back({{"total s", 7, named("seconds_total")}, 4});
    columns.push_back({{"ref. est.", 10, named("reference_error_estimate")}, 6});

    columns.erase(std::remove_if(columns.begin(),
                                 columns.end(),
                                 [&](const RankedColumn &column) {
                                   return is_empty(column.column.column, records);
                                 }),
                  columns.end());
    return narrowed(std::move(columns));
  }
} // namespace tetradapt::report
