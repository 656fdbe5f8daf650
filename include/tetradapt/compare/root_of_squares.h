// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_root_of_squares_h
#define tetradapt_compare_root_of_squares_h

#include <cmath>
#include <vector>

namespace tetradapt::compare
{
  /** Root of the sum of squares. */
  inline double
  root_of_squares(const std::vector<double> &values)
  {
    double sum = 0.;
    for (const double v : values)
      sum += v * v;
    return std::sqrt(sum);
  }
} // namespace tetradapt::compare

#endif
