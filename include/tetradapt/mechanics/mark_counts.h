// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_mark_counts_h
#define tetradapt_mechanics_mark_counts_h

#include <array>
#include <cstddef>
#include <vector>

namespace tetradapt::mechanics
{
  /**
   * How fast a function varies, by its second differences d over steps h of a grid, relative to its
   * largest value. A wave or a bell curve of width w has d = (h / w)^2, a jump has d near 1.
   * The edges of a part in which nothing is missed may be a few widths long, as the points of a
   * rule and of its rim are at most a third of an edge apart.
   */
  struct FeatureLevels
  {
    double fine, fine_parts;     ///< differences over one step; steps a part where they are larger
    double medium, medium_parts; ///< the same
    double coarse, coarse_parts; ///< the same with differences over stride steps

    static constexpr unsigned int stride = 4;
  };

  /** Marks on the nodes of a regular grid, and whether there is any in a range, in constant
   * time: by sums of the marks over all nodes with lower numbers. */
  class MarkCounts
  {
  public:
    using Index = std::array<unsigned int, 3>;

    MarkCounts() = default;
    /** @param n nodes in each direction. @param marks one a node, the first direction fastest. */
    MarkCounts(const Index &n, const std::vector<char> &marks);

    /** Whether a node from @p first - @p margin to @p last + @p margin, both included, is marked;
     * there are none outside of the grid. */
    bool
    any(Index first, Index last, unsigned int margin = 0) const;

    std::size_t
    n_marks() const
    {
      return sums.empty() ? 0 : sums.back();
    }

  private:
    std::size_t
    node(unsigned int i, unsigned int j, unsigned int k) const
    {
      return (std::size_t(k) * n[1] + j) * n[0] + i;
    }

    Index                     n{};
    std::vector<unsigned int> sums;
  };
} // namespace tetradapt::mechanics

#endif
