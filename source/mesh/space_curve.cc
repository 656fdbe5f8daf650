// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/space_curve.h"

#include <boost/sort/spreadsort/integer_sort.hpp>

#include <algorithm>

namespace tetradapt::mesh
{
  namespace
  {
    constexpr unsigned int bits = 21;

    /** Moves bit i of a 21-bit number to bit 3i. */
    std::uint64_t
    spread(std::uint64_t x)
    {
      x &= 0x1fffff;
      x = (x | x << 32) & 0x1f00000000ffffULL;
      x = (x | x << 16) & 0x1f0000ff0000ffULL;
      x = (x | x << 8) & 0x100f00f00f00f00fULL;
      x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
      x = (x | x << 2) & 0x1249249249249249ULL;
      return x;
    }

    struct Entry
    {
      std::uint64_t key;
      unsigned int  number;

      bool
      operator<(const Entry &other) const
      {
        return key != other.key ? key < other.key : number < other.number;
      }
    };
  } // namespace

  SpaceCurve::SpaceCurve(const Point<3> &lower, const Point<3> &upper) : origin(lower)
  {
    double size = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      size = std::max(size, upper[d] - lower[d]);
    // A single point has no extent: everything falls on position 0.
    scale = size > 0. ? double((1u << bits) - 1) / size : 0.;
  }

  std::uint64_t
  SpaceCurve::operator()(const Point<3> &point) const
  {
    std::uint64_t key = 0;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const double x
          = std::min(std::max((point[d] - origin[d]) * scale, 0.), double((1u << bits) - 1));
        key |= spread(static_cast<std::uint64_t>(x)) << (2 - d);
      }
    return key;
  }

  std::vector<unsigned int>
  SpaceCurve::order(const std::vector<Point<3>> &points) const
  {
    std::vector<Entry> entries(points.size());
    for (unsigned int i = 0; i < points.size(); ++i)
      entries[i] = {(*this)(points[i]), i};
    boost::sort::spreadsort::integer_sort(entries.begin(),
                                          entries.end(),
                                          [](const Entry &e, const unsigned int offset) {
                                            return e.key >> offset;
                                          });
    std::vector<unsigned int> numbers(points.size());
    for (std::size_t i = 0; i < entries.size(); ++i)
      numbers[i] = entries[i].number;
    return numbers;
  }
} // namespace tetradapt::mesh
