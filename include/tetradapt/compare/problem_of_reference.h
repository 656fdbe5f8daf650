// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_problem_of_reference_h
#define tetradapt_compare_problem_of_reference_h

#include "tetradapt/compare/reference_cache.h"

#include <string>

namespace tetradapt::compare
{
  /** What is wrong with a reference of which nothing has been looked at (every index,
   * length and number), or an empty text: a checksum only tells that a file is as it was
   * written. */
  std::string
  problem_of_reference(const CachedReference &reference);
} // namespace tetradapt::compare

#endif
