// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/record_columns.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace tetradapt::report
{
  namespace
  {
    using Record = adapt::CycleRecord;
    using Value  = std::optional<double>;
    using Kind   = RecordColumn::Kind;

    std::string
    error_source_name(const adapt::ErrorSource source)
    {
      switch (source)
        {
        case adapt::ErrorSource::exact:
          return "exact";
        case adapt::ErrorSource::known_energy:
          return "known energy";
        case adapt::ErrorSource::reference:
          return "reference";
        case adapt::ErrorSource::none:
          break;
        }
      return "";
    }

    RecordColumn
    text_column(const std::string &name, std::function<std::string(const Record &)> text)
    {
      return {name, Kind::text, [](const Record &) { return Value(); }, "", std::move(text)};
    }

    /** What is known of the accuracy of a cycle, and from where. */
    std::string
    error_source(const Record &record)
    {
      if (record.energy_error)
        return error_source_name(record.error_source);
      return record.estimate ? "estimate " + record.estimate_source : "";
    }

    const std::vector<RecordColumn> &
    fixed_columns()
    {
      static const std::vector<RecordColumn> columns{
        {"cycle", Kind::count, [](const Record &r) -> Value { return r.cycle; }, ""},
        {"points", Kind::count, [](const Record &r) -> Value { return r.points; }, ""},
        {"tets", Kind::count, [](const Record &r) -> Value { return r.tets; }, ""},
        {"dofs", Kind::count, [](const Record &r) -> Value { return r.dofs; }, ""},
        {"mean_ren", Kind::figure, [](const Record &r) { return r.mean_ren; }, ""},
        {"max_ren", Kind::figure, [](const Record &r) { return r.max_ren; }, ""},
        {"relative_l2_error",
         Kind::figure,
         [](const Record &r) { return r.relative_l2_error; },
         ""},
        {"relative_energy_error",
         Kind::figure,
         [](const Record &r) { return r.relative_energy_error; },
         ""},
        text_column("error_source", error_source),
        {"estimate", Kind::figure, [](const Record &r) { return r.estimate; }, ""},
        text_column("estimate_source", [](const Record &r) { return r.estimate_source; }),
        {"effectivity", Kind::figure, [](const Record &r) { return r.effectivity; }, ""},
        {"strain_energy",
         Kind::figure,
         [](const Record &r) -> Value { return r.strain_energy; },
         ""},
        {"max_displacement",
         Kind::figure,
         [](const Record &r) -> Value { return r.max_displacement; },
         ""},
        {"seconds_mesh",
         Kind::seconds,
         [](const Record &r) -> Value { return r.seconds_mesh; },
         ""},
        {"seconds_solve",
         Kind::seconds,
         [](const Record &r) -> Value { return r.seconds_solve; },
         ""},
        {"seconds_estimate",
         Kind::seconds,
         [](const Record &r) -> Value { return r.seconds_estimate; },
         ""},
        {"seconds_total",
         Kind::seconds,
         [](const Record &r) -> Value { return r.seconds_total; },
         ""},
        {"l2_error", Kind::figure, [](const Record &r) { return r.l2_error; }, ""},
        {"h1_error", Kind::figure, [](const Record &r) { return r.h1_error; }, ""},
        {"relative_h1_error",
         Kind::figure,
         [](const Record &r) { return r.relative_h1_error; },
         ""},
        text_column("displacement_error_source",
                    [](const Record &r) { return error_source_name(r.displacement_error_source); }),
        {"energy_error", Kind::figure, [](const Record &r) { return r.energy_error; }, ""},
        {"relative_estimate",
         Kind::figure,
         [](const Record &r) { return r.relative_estimate; },
         ""},
        {"reference_error_estimate",
         Kind::figure,
         [](const Record &r) { return r.reference_error_estimate; },
         ""},
        {"iterations", Kind::count, [](const Record &r) -> Value { return r.iterations; }, ""},
        {"accepted",
         Kind::count,
         [](const Record &r) -> Value { return r.acceptance == adapt::Acceptance::accepted; },
         ""}};
      return columns;
    }

    /** The texts of an estimator or goal as a part of a column's name. */
    std::string
    name_part(const std::string &text)
    {
      std::string name;
      for (const unsigned char c : text)
        name += c >= 128 || std::isalnum(c) || c == '-' || c == '.' ? char(c) : '_';
      return name;
    }

    /** The entry called @p name in a list of records; null if there is none. */
    template <typename Entry>
    const Entry *
    find(const std::vector<Entry> &entries, const std::string &name)
    {
      const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry &entry) {
        return entry.name == name;
      });
      return found == entries.end() ? nullptr : &*found;
    }

    /** Names of all entries of a list of the records, in the order in which they come. */
    template <typename Entry>
    std::vector<std::string>
    names_of(const std::vector<Record> &records, const std::vector<Entry> Record::*list)
    {
      std::vector<std::string> names;
      for (const Record &record : records)
        for (const Entry &entry : record.*list)
          if (std::find(names.begin(), names.end(), entry.name) == names.end())
            names.push_back(entry.name);
      return names;
    }

    /** A column of what @p member is in the entry called @p name of a list. */
    template <typename Entry, typename Member>
    RecordColumn
    column_of(const std::vector<Entry> Record::*list,
              const std::string                &name,
              const Member Entry::*member,
              const std::string   &column_name,
              const std::string   &part,
              const Kind           kind = Kind::figure)
    {
      return {column_name,
              kind,
              [=](const Record &r) -> Value {
                const Entry *entry = find(r.*list, name);
                return entry == nullptr ? Value() : Value(entry->*member);
              },
              part};
    }

    void
    add_estimator(const std::string &name, std::vector<RecordColumn> &columns)
    {
      using Entry            = adapt::EstimateRecord;
      const auto        list = &Record::estimates;
      const std::string end  = "_" + name_part(name);
      const std::string part = "estimator " + name;
      const auto        add  = [&](const std::string &start, const auto member, const Kind kind) {
        columns.push_back(column_of<Entry>(list, name, member, start + end, part, kind));
      };
      add("estimate", &Entry::global, Kind::figure);
      add("relative_estimate", &Entry::relative, Kind::figure);
      add("effectivity", &Entry::effectivity, Kind::figure);
      add("local_effectivity_deviation", &Entry::local_deviation, Kind::figure);
      add("seconds", &Entry::seconds, Kind::seconds);
    }

    void
    add_goal(const std::string &name, std::vector<RecordColumn> &columns)
    {
      using Entry             = adapt::GoalRecord;
      const auto        list  = &Record::goals;
      const std::string start = "goal_" + name_part(name);
      const std::string part  = "goal " + name;
      const auto        add   = [&](const std::string &end, const auto member) {
        columns.push_back(column_of<Entry>(list, name, member, start + end, part));
      };
      add("", &Entry::value);
      add("_exact", &Entry::exact);
      add("_error", &Entry::error);
      add("_error_estimate", &Entry::error_estimate);
      add("_effectivity", &Entry::effectivity);
    }

    void
    add_solver(std::vector<RecordColumn> &columns)
    {
      columns.push_back({"iterations_to_tolerance",
                         Kind::count,
                         [](const Record &r) {
                           return r.iterations_to_tolerance > 0 ? Value(r.iterations_to_tolerance)
                                                                : Value();
                         },
                         "solver"});
      columns.push_back({"algebraic_error_estimate",
                         Kind::figure,
                         [](const Record &r) { return r.algebraic_error; },
                         "solver"});
    }

    void
    add_springs(std::vector<RecordColumn> &columns)
    {
      columns.push_back({"spring_energy",
                         Kind::figure,
                         [](const Record &r) { return r.spring_energy; },
                         "springs"});
    }

    /** @p with_projection: whether points were moved to a curved boundary. */
    void
    add_mesh(const bool with_projection, std::vector<RecordColumn> &columns)
    {
      const auto add = [&](const std::string &name, const Kind kind, const auto member) {
        columns.push_back({name,
                           kind,
                           [member](const Record &r) -> Value {
                             // No tetrahedron has zero degrees only: nothing was reported.
                             return r.mesh.max_dihedral > 0. ? Value(r.mesh.*member) : Value();
                           },
                           "mesh"});
      };
      using Mesh = adapt::MeshRecord;
      columns.push_back({"requested_tets",
                         Kind::figure,
                         [](const Record &r) { return r.mesh.requested_tets; },
                         "mesh"});
      add("oversized_tets", Kind::count, &Mesh::oversized_tets);
      columns.push_back({"volume_drift",
                         Kind::figure,
                         [](const Record &r) -> Value {
                           return r.mesh.max_dihedral > 0. ? Value(visible_drift(r.mesh)) : Value();
                         },
                         "mesh"});
      if (with_projection)
        {
          add("largest_projection", Kind::figure, &Mesh::largest_projection);
          add("unprojected_points", Kind::count, &Mesh::unprojected_points);
        }
      add("min_dihedral", Kind::figure, &Mesh::min_dihedral);
      add("max_dihedral", Kind::figure, &Mesh::max_dihedral);
      add("max_aspect_ratio", Kind::figure, &Mesh::max_aspect_ratio);
    }

    bool
    has_value(const RecordColumn &column, const std::vector<Record> &records)
    {
      return std::any_of(records.begin(), records.end(), [&](const Record &record) {
        return column.has_value(record);
      });
    }

    /** Different names that read alike once blanks are underscores get numbers. */
    void
    make_names_unique(std::vector<RecordColumn> &columns)
    {
      for (std::size_t i = 0; i < columns.size(); ++i)
        {
          const std::string name = columns[i].name;
          for (unsigned int number = 2; std::any_of(columns.begin(),
                                                    columns.begin() + i,
                                                    [&](const RecordColumn &other) {
                                                      return other.name == columns[i].name;
                                                    });
               ++number)
            columns[i].name = name + "_" + std::to_string(number);
        }
    }
  } // namespace

  std::vector<RecordColumn>
  possible_columns(const std::vector<std::string> &estimators,
                   const std::vector<std::string> &goals,
                   const bool                      with_projection)
  {
    std::vector<RecordColumn> columns = fixed_columns();
    add_solver(columns);
    add_springs(columns);
    for (const std::string &name : estimators)
      add_estimator(name, columns);
    for (const std::string &name : goals)
      add_goal(name, columns);
    add_mesh(with_projection, columns);
    return columns;
  }

  std::vector<RecordColumn>
  record_columns(const std::vector<adapt::CycleRecord> &records)
  {
    const bool with_projection = std::any_of(records.begin(), records.end(), [](const Record &r) {
      return r.mesh.largest_projection > 0. || r.mesh.unprojected_points > 0;
    });
    auto columns = possible_columns(names_of<adapt::EstimateRecord>(records, &Record::estimates),
                                    names_of<adapt::GoalRecord>(records, &Record::goals),
                                    with_projection);
    columns.erase(std::remove_if(columns.begin() + fixed_columns().size(),
                                 columns.end(),
                                 [&](const RecordColumn &column) {
                                   return !has_value(column, records);
                                 }),
                  columns.end());
    make_names_unique(columns);
    return columns;
  }
} // namespace tetradapt::report
