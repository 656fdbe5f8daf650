// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/record_columns.h"

#include <array>
#include <charconv>

namespace tetradapt::report
{
  const std::vector<RecordColumn> &
  record_columns()
  {
    using Record = adapt::CycleRecord;
    using Value  = std::optional<double>;
    constexpr auto count{RecordColumn::Kind::count};
    constexpr auto figure{RecordColumn::Kind::figure};
    constexpr auto seconds{RecordColumn::Kind::seconds};

    static const std::vector<RecordColumn> columns{
      {"cycle", "cycle", 5, count, [](const Record &r) -> Value { return r.cycle; }},
      {"points", "points", 8, count, [](const Record &r) -> Value { return r.points; }},
      {"tets", "tets", 8, count, [](const Record &r) -> Value { return r.tets; }},
      {"dofs", "dofs", 9, count, [](const Record &r) -> Value { return r.dofs; }},
      {"mean_ren", "mean REN", 9, figure, [](const Record &r) { return r.mean_ren; }},
      {"max_ren", "max REN", 9, figure, [](const Record &r) { return r.max_ren; }},
      {"relative_l2_error",
       "rel L2",
       9,
       figure,
       [](const Record &r) { return r.relative_l2_error; }},
      {"relative_energy_error",
       "rel energy",
       10,
       figure,
       [](const Record &r) { return r.relative_energy_error; }},
      {"estimate", "estimate", 9, figure, [](const Record &r) { return r.estimate; }},
      {"effectivity", "effect.", 7, figure, [](const Record &r) { return r.effectivity; }},
      {"strain_energy",
       "strain en.",
       11,
       figure,
       [](const Record &r) -> Value { return r.strain_energy; }},
      {"max_displacement",
       "max displ.",
       10,
       figure,
       [](const Record &r) -> Value { return r.max_displacement; }},
      {"seconds_mesh",
       "mesh s",
       7,
       seconds,
       [](const Record &r) -> Value { return r.seconds_mesh; }},
      {"seconds_solve",
       "solve s",
       7,
       seconds,
       [](const Record &r) -> Value { return r.seconds_solve; }},
      {"seconds_estimate",
       "est. s",
       7,
       seconds,
       [](const Record &r) -> Value { return r.seconds_estimate; }},
      {"seconds_total",
       "total s",
       7,
       seconds,
       [](const Record &r) -> Value { return r.seconds_total; }},
      {"l2_error", nullptr, 0, figure, [](const Record &r) { return r.l2_error; }},
      {"h1_error", nullptr, 0, figure, [](const Record &r) { return r.h1_error; }},
      {"relative_h1_error",
       nullptr,
       0,
       figure,
       [](const Record &r) { return r.relative_h1_error; }},
      {"energy_error", nullptr, 0, figure, [](const Record &r) { return r.energy_error; }},
      {"relative_estimate",
       nullptr,
       0,
       figure,
       [](const Record &r) { return r.relative_estimate; }},
      {"reference_error",
       "ref. err.",
       9,
       figure,
       [](const Record &r) { return r.reference_error; }},
      {"iterations", nullptr, 0, count, [](const Record &r) -> Value { return r.iterations; }}};
    return columns;
  }

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
} // namespace tetradapt::report
