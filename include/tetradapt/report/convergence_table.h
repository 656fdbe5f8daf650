// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_convergence_table_h
#define tetradapt_report_convergence_table_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/core/log.h"
#include "tetradapt/report/record_columns.h"
#include "tetradapt/report/result_folder.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace tetradapt::report
{
  /** The names of @p columns, separated by commas. */
  std::string
  csv_heading(const std::vector<RecordColumn> &columns);

  /** The figures of a cycle, separated by commas: 10 significant digits, nothing where
   * there is no figure. */
  std::string
  csv_row(const std::vector<RecordColumn> &columns, const adapt::CycleRecord &record);

  /** convergence.csv: a header row with the names of record_columns(), then one row
   * a cycle. */
  std::string
  csv_table(const std::vector<adapt::CycleRecord> &records);

  /**
   * The same as tables aligned for reading, one for the cycles as such and one for each
   * estimator, each goal and the mesh: 7 significant digits, seconds with
   * three decimals, "-" for a figure that is missing. A column that is empty in
   * every row is left out.
   */
  std::string
  text_table(const std::vector<adapt::CycleRecord> &records);

  /** The heading of the terminal's table, without an end of line. */
  std::string
  terminal_heading(const std::vector<TerminalColumn> &columns);

  /** One row of the terminal's table, without an end of line. */
  std::string
  terminal_row(const std::vector<TerminalColumn> &columns, const adapt::CycleRecord &record);

  /**
   * Writes the figures of every cycle: to a stream as they come, and after each
   * cycle to convergence.csv and convergence.txt, which are whole at any time.
   */
  class ConvergenceTable : public adapt::Observer
  {
  public:
    /**
     * @param folder   where the files go; null: none are written. Must outlive the object.
     * @param terminal  where rows are printed as they come, normally std::cout;
     *                  null: nowhere. Must outlive the object.
     * @param log       cleared of a progress line before a row is printed. Must
     *                  outlive the object.
     */
    ConvergenceTable(ResultFolder *folder, std::ostream *terminal, const core::Log &log);

    /** Begins a new table. */
    void
    run_started(const scene::Scene &scene) override;

    /** @throws InputError or NumericalError if a file cannot be written. */
    void
    cycle_done(const adapt::CycleEvent &event) override;

    /** The rows so far. */
    const std::vector<adapt::CycleRecord> &
    records() const
    {
      return rows;
    }

  private:
    ResultFolder                   *folder;
    std::ostream                   *terminal;
    const core::Log                &log;
    std::vector<adapt::CycleRecord> rows;
    std::string                     heading; ///< the last one printed
    unsigned int                    rows_below_heading = 0;
  };
} // namespace tetradapt::report

#endif
