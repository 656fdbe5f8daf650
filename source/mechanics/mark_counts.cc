// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/mark_counts.h"

#include <algorithm>

namespace tetradapt::mechanics
{
  MarkCounts::MarkCounts(const Index &n, const std::vector<char> &marks) : n(n), sums(marks.size())
  {
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        {
          unsigned int row = 0;
          for (unsigned int i = 0; i < n[0]; ++i)
            {
              row += marks[node(i, j, k)] != 0;
              unsigned int sum = row;
              if (j > 0)
                sum += sums[node(i, j - 1, k)];
              if (k > 0)
                sum += sums[node(i, j, k - 1)];
              if (j > 0 && k > 0)
                sum -= sums[node(i, j - 1, k - 1)];
              sums[node(i, j, k)] = sum;
            }
        }
  }

  bool
  MarkCounts::any(Index first, Index last, const unsigned int margin) const
  {
    for (unsigned int d = 0; d < 3; ++d)
      {
        first[d] -= std::min(first[d], margin);
        last[d] = std::min(last[d] + margin, n[d] - 1);
      }
    unsigned int sum = 0;
    for (unsigned int corner = 0; corner < 8; ++corner)
      {
        unsigned int at[3];
        bool         outside = false, negative = false;
        for (unsigned int d = 0; d < 3; ++d)
          if ((corner >> d & 1) != 0)
            {
              outside  = outside || first[d] == 0;
              at[d]    = first[d] - 1;
              negative = !negative;
            }
          else
            at[d] = last[d];
        if (!outside)
          sum += negative ? -sums[node(at[0], at[1], at[2])] : sums[node(at[0], at[1], at[2])];
      }
    return sum != 0;
  }
} // namespace tetradapt::mechanics
