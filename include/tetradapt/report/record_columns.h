// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_record_columns_h
#define tetradapt_report_record_columns_h

#include "tetradapt/adapt/observer.h"

#include <optional>
#include <string>
#include <vector>

namespace tetradapt::report
{
  /** One figure of a cycle: how it is named and where it is found. All tables and
   * the field data of the .vtu files are made from one list of these. */
  struct RecordColumn
  {
    enum class Kind
    {
      count,  ///< an integer
      figure, ///< any number
      seconds ///< a time
    };
    const char *name; ///< in convergence.csv
    /** Short heading in the terminal's table; null: not shown there. */
    const char  *heading;
    unsigned int width; ///< characters in the terminal's table
    Kind         kind;
    /** The figure; empty where the scene does not have it. */
    std::optional<double> (*value)(const adapt::CycleRecord &);
  };

  /** All figures of a CycleRecord in the order of convergence.csv. */
  const std::vector<RecordColumn> &
  record_columns();

  /**
   * @p value with @p digits significant digits, without trailing zeros ("%.{digits}g",
   * whatever the locale); read back it is the same to that many digits.
   */
  std::string
  format_number(double value, unsigned int digits);

  /** @p value with @p decimals digits after the point. */
  std::string
  format_fixed(double value, unsigned int decimals);
} // namespace tetradapt::report

#endif
