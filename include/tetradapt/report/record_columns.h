// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_record_columns_h
#define tetradapt_report_record_columns_h

#include "tetradapt/adapt/observer.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tetradapt::report
{
  /** One figure of a cycle: how it is named and where it is found. All tables and
   * the field data of the .vtu files are made from lists of these. */
  struct RecordColumn
  {
    enum class Kind
    {
      count,   ///< an integer
      figure,  ///< any number
      seconds, ///< a time
      text     ///< a word
    };
    std::string name; ///< in convergence.csv: letters, digits, '_', '-', '.' only
    Kind        kind = Kind::figure;
    /** The figure; empty where a cycle does not have it. */
    std::function<std::optional<double>(const adapt::CycleRecord &)> value;
    /** What the figure is about, for tables in parts: "estimator spr", "goal tip", "mesh";
     * empty: the cycle as a whole. */
    std::string part;
    /** Of Kind::text, in place of value: the word; empty where a cycle does not have it. */
    std::function<std::string(const adapt::CycleRecord &)> text = {};

    /** Whether @p record has the figure or the word. */
    bool
    has_value(const adapt::CycleRecord &record) const;

    /** The cell of a table, as format_cell() makes it. */
    std::string
    cell(const adapt::CycleRecord &record,
         unsigned int              digits,
         int                       decimals_of_seconds,
         const std::string        &missing) const;
  };

  /**
   * The columns of convergence.csv for the cycles of one run or of several. First those
   * that every run has, in an order that does not change; then whatever a cycle has: of
   * each estimator estimate_<name>, relative_estimate_<name>, effectivity_<name>,
   * local_effectivity_deviation_<name> and seconds_<name>, of each goal goal_<name>,
   * goal_<name>_exact, _error, _error_estimate and _effectivity, and of the mesh what was asked for
   * and what came of it. Of the latter, a column is there if a record has a figure for it.
   * doc/columns.md has the formula and the unit of each.
   */
  std::vector<RecordColumn>
  record_columns(const std::vector<adapt::CycleRecord> &records);

  /** All columns that record_columns() can give for estimators and goals of these names;
   * @p with_projection: also those about points that were moved to a curved boundary. */
  std::vector<RecordColumn>
  possible_columns(const std::vector<std::string> &estimators,
                   const std::vector<std::string> &goals,
                   bool                            with_projection);

  /** A column of the terminal's table. */
  struct TerminalColumn
  {
    std::string  heading;
    unsigned int width = 0; ///< characters
    RecordColumn column;
  };

  /** The few figures that a user watches, as far as the records have them and 80 characters
   * have room: sizes, errors, the driving estimator and its effectivity, the first goal, the
   * time. What is less important is left out first. */
  std::vector<TerminalColumn>
  terminal_columns(const std::vector<adapt::CycleRecord> &records);

  /** MeshRecord::volume_drift, or 0 where it is a sum of rounding errors. */
  double
  visible_drift(const adapt::MeshRecord &mesh);

  /** Lower ends in degrees of the classes of MeshRecord::dihedral_histogram. */
  extern const std::array<unsigned int, 8> dihedral_class_begins;

  /** "dihedral_0_to_5", ..., "dihedral_from_60": the classes of
   * MeshRecord::dihedral_histogram. */
  std::string
  dihedral_class_name(unsigned int number);

  /**
   * @p value with @p digits significant digits, without trailing zeros ("%.{digits}g",
   * whatever the locale); read back it is the same to that many digits.
   */
  std::string
  format_number(double value, unsigned int digits);

  /** @p value with @p decimals digits after the point. */
  std::string
  format_fixed(double value, unsigned int decimals);

  /** The cell of a table: counts without a point, figures with @p digits significant
   * digits, seconds with @p decimals_of_seconds (negative: as figures); @p missing if there
   * is no value. */
  std::string
  format_cell(RecordColumn::Kind           kind,
              const std::optional<double> &value,
              unsigned int                 digits,
              int                          decimals_of_seconds,
              const std::string           &missing);

  /** A cell of a .csv file with any text: in quotation marks if it needs them. */
  std::string
  csv_text(const std::string &text);

  /** Rows of cells, the first one a heading, as lines; each column as wide as its widest
   * cell (counted in characters of UTF-8) and right-aligned, the first @p n_left columns
   * left-aligned. Ends with a line end. */
  std::string
  aligned_table(const std::vector<std::vector<std::string>> &rows, unsigned int n_left = 0);
} // namespace tetradapt::report

#endif
