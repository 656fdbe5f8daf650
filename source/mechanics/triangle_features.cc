// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/triangle_features.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetradapt::mechanics
{
  namespace
  {
    /** Sharper than in the volume, as faces take few points: kinks are also seen, and the corner of
     * a patch between two points of a rim is small. */
    constexpr FeatureLevels levels{0.3, 0.5, 0.02, 2., 0.04, 8.};
  } // namespace

  TriangleFeatures::TriangleFeatures(const std::array<Point<3>, 3>     &corners,
                                     const DensitySampler<3>::Function &density,
                                     const double                       step,
                                     const double                       largest)
    : step(step)
  {
    const double longest = std::max({corners[0].distance(corners[1]),
                                     corners[1].distance(corners[2]),
                                     corners[2].distance(corners[0])});
    n                    = static_cast<unsigned int>(std::ceil(longest / step));
    if (n < 3)
      return; // parts are small enough
    const unsigned int        row = n + 1;
    std::vector<Tensor<1, 3>> values(std::size_t(row) * row);
    constexpr double          inwards = 1e-6;
    for (unsigned int j = 0; j <= n; ++j)
      for (unsigned int i = 0; i + j <= n; ++i)
        {
          const double s = inwards / 3. + (1. - inwards) * i / n,
                       t = inwards / 3. + (1. - inwards) * j / n;
          values[std::size_t(j) * row + i]
            = density(corners[0] + s * (corners[1] - corners[0]) + t * (corners[2] - corners[0]));
        }
    std::vector<char> marks(values.size(), 0), medium_marks(values.size(), 0),
      coarse_marks(values.size(), 0);
    // Along the three edges: differences of numbers, first direction fastest.
    constexpr int directions[3][2] = {{1, 0}, {0, 1}, {1, -1}};
    const auto    is_inside        = [this](const int i, const int j) {
      return i >= 0 && j >= 0 && i + j <= static_cast<int>(n);
    };
    const auto differs = [&](int i, int j, int di, int dj, double limit) {
      // At the rim, the differences nearest to it tell.
      for (int shift : {0, 1, -1})
        {
          const int a = i + shift * di, b = j + shift * dj;
          if (is_inside(a - di, b - dj) && is_inside(a + di, b + dj))
            return (values[(b - dj) * row + a - di] - 2. * values[b * row + a]
                    + values[(b + dj) * row + a + di])
                     .norm()
                   > limit * largest;
        }
      return false;
    };
    constexpr int stride = FeatureLevels::stride;
    for (int j = 0; j <= static_cast<int>(n); ++j)
      for (int i = 0; i + j <= static_cast<int>(n); ++i)
        for (const auto &d : directions)
          {
            if (differs(i, j, d[0], d[1], levels.fine))
              marks[std::size_t(j) * row + i] = 1;
            if (differs(i, j, d[0], d[1], levels.medium))
              medium_marks[std::size_t(j) * row + i] = 1;
            if (differs(i, j, stride * d[0], stride * d[1], levels.coarse))
              coarse_marks[std::size_t(j) * row + i] = 1;
          }
    fine   = MarkCounts({{row, row, 1}}, marks);
    medium = MarkCounts({{row, row, 1}}, medium_marks);
    coarse = MarkCounts({{row, row, 1}}, coarse_marks);
  }

  double
  TriangleFeatures::part_size(const mesh::PartCorners<3> &part) const
  {
    if (n < 3)
      return levels.fine_parts * step;
    MarkCounts::Index first{{0, 0, 0}}, last{{0, 0, 0}};
    for (unsigned int d = 0; d < 2; ++d)
      {
        const auto [low, high] = std::minmax({part[0][d + 1], part[1][d + 1], part[2][d + 1]});
        first[d]               = static_cast<unsigned int>(std::max(0., std::floor(low * n)));
        last[d]                = std::min(n, static_cast<unsigned int>(std::ceil(high * n)));
      }
    return fine.any(first, last)     ? levels.fine_parts * step
           : medium.any(first, last) ? levels.medium_parts * step
           : coarse.any(first, last, FeatureLevels::stride)
             ? levels.coarse_parts * step
             : std::numeric_limits<double>::infinity();
  }
} // namespace tetradapt::mechanics
