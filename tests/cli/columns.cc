// SPDX-License-Identifier: AGPL-3.0-or-later
//
// doc/columns.md names all columns and plots that the program can write, and no others.

#include "tetradapt/cli/study_tables.h"
#include "tetradapt/report/convergence_table.h"
#include "tetradapt/report/mesh_report.h"
#include "tetradapt/report/plots.h"
#include "tetradapt/report/reactions.h"
#include "tetradapt/report/results.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

using namespace tetradapt;
using Names = std::set<std::string>;

namespace
{
  /** Names in the first column of each section's table, by the files in its heading. */
  std::map<std::string, Names>
  documented()
  {
    std::ifstream                in(SOURCE_DIR "/../../doc/columns.md");
    std::map<std::string, Names> names;
    std::string                  line, section;
    while (std::getline(in, line))
      if (line.rfind("## ", 0) == 0)
        section = line.substr(3);
      else if (line.rfind("| `", 0) == 0)
        {
          const std::string name = line.substr(3, line.find('`', 3) - 3);
          if (!names[section].insert(name).second)
            std::cout << section << ": " << name << " stands there twice\n";
        }
    return names;
  }

  /** The names in a heading, with a name as the user gives it as <kind>. */
  Names
  parts_of(const std::string &heading, const char separator)
  {
    Names              names;
    std::istringstream in(heading);
    for (std::string name; std::getline(in, name, separator);)
      {
        for (const std::string kind : {"estimator", "goal", "variation", "parameter"})
          for (auto at = name.find("USERS-" + kind); at != std::string::npos;
               at      = name.find("USERS-" + kind))
            name.replace(at, 6 + kind.size(), "<" + kind + ">");
        if (!name.empty())
          names.insert(name);
      }
    return names;
  }

  void
  compare(const std::string &section, const Names &written)
  {
    const Names right = documented()[section];
    std::cout << section << ": " << (right == written ? "agrees" : "DIFFERS") << '\n';
    for (const std::string &name : written)
      if (right.count(name) == 0)
        std::cout << "  not documented: " << name << '\n';
    for (const std::string &name : right)
      if (written.count(name) == 0)
        std::cout << "  never written: " << name << '\n';
  }

  std::string
  first_line(const std::string &text)
  {
    return text.substr(0, text.find('\n'));
  }

  void
  plots()
  {
    adapt::CycleRecord record;
    record.relative_energy_error = 0.5;
    Names names{"indicators"}; // which RunPlots draws of each cell's value
    for (const auto &plot : report::plots_of_run(scene::Scene(), {record, record}))
      names.insert(plot.name);
    for (const auto &plot : report::plots_of_study("s", {{"run", 1, 0, 0, {record, record}}}))
      names.insert(plot.name);
    compare("`plots/*.gp`", names);
  }
} // namespace

int
main()
{
  const auto columns = report::possible_columns({"USERS-estimator"}, {"USERS-goal"}, true);
  compare("`convergence.csv`, `convergence.txt`", parts_of(report::csv_heading(columns), ','));
  compare("`mesh.csv`", parts_of(first_line(report::csv_meshes({})), ','));
  compare("`reactions.csv`", parts_of(first_line(report::csv_reactions({})), ','));
  compare("`regions.csv`", parts_of(first_line(report::csv_regions({})), ','));
  compare("`results.csv`, `results.txt`", parts_of(first_line(report::csv_results({})), ','));

  scene::Scene study;
  study.variations.resize(1);
  study.variations[0].name       = "USERS-variation";
  study.variations[0].parameters = {"USERS-parameter"};
  Names       names              = parts_of(first_line(cli::csv_study(study, {}, {})), ',');
  const Names of_cycles          = parts_of(report::csv_heading(report::record_columns({})), ',');
  for (const std::string &name : of_cycles)
    names.erase(name);
  compare("`study.csv`", names);
  // Headings with blanks are aligned by blanks; here they have an underscore.
  std::string heading = first_line(cli::text_study({}, {}));
  for (const std::string name : {"rel error", "mean REN"})
    if (heading.find(name) != std::string::npos)
      heading[heading.find(name) + name.find(' ')] = '_';
  compare("`study.txt`", parts_of(heading, ' '));
  plots();

  // The study's table on a screen: the longest label is cut, whole characters at a time.
  std::vector<cli::StudyRun>     runs(2);
  std::vector<cli::StudyOutcome> outcomes(2);
  runs[0].label = "short";
  for (unsigned int i = 0; i < 60; ++i)
    runs[1].label += "\xC3\xA9";
  for (auto &outcome : outcomes)
    {
      outcome.records.resize(3);
      outcome.records.back().dofs                  = 123456789;
      outcome.records.back().relative_energy_error = 1.2345678e-9;
      outcome.is_done                              = true;
    }
  std::cout << cli::text_study(runs, outcomes, 80)
            << "sections of the page: " << documented().size() << std::endl;
}
