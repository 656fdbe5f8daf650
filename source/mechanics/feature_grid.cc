// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/feature_grid.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetradapt::mechanics
{
  namespace
  {
    /** Widths of 2, 4 and 8 steps. */
    constexpr FeatureLevels levels{0.25, 3., 0.0625, 5., 0.25, 8.};
  } // namespace

  FeatureGrid::FeatureGrid(const std::function<Tensor<1, 3>(const Point<3> &)> &function,
                           const Point<3>                                      &lower,
                           const Point<3>                                      &upper,
                           const double                                         step,
                           const std::size_t                                    most_nodes,
                           const ForEachCell                                   &cells)
    : used_step(step)
  {
    const auto fits = [&]() {
      double nodes = 1.;
      for (unsigned int d = 0; d < 3; ++d)
        nodes *= std::ceil((upper[d] - lower[d]) / used_step) + 3.;
      return nodes <= double(most_nodes);
    };
    while (!fits())
      used_step *= 1.1;
    for (unsigned int d = 0; d < 3; ++d)
      {
        n[d]      = static_cast<unsigned int>(std::ceil((upper[d] - lower[d]) / used_step)) + 3;
        origin[d] = lower[d] - used_step;
      }
    const std::size_t         n_nodes = std::size_t(n[0]) * n[1] * n[2];
    std::vector<Tensor<1, 3>> values(n_nodes);
    std::vector<char>         unknown(n_nodes, 0);
    const std::vector<char>   inside  = nodes_in(cells);
    double                    largest = 0.;
    std::size_t               known   = 0;
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          {
            const Point<3> x = origin + Point<3>(i * used_step, j * used_step, k * used_step);
            try
              {
                const Tensor<1, 3> value = function(x);
                const double       size  = value.norm();
                values[node(i, j, k)]    = value;
                if (inside[node(i, j, k)] == 0)
                  continue;
                largest = std::max(largest, size);
                mean_size += size;
                ++known;
              }
            catch (const core::InputError &)
              {
                unknown[node(i, j, k)] = 1;
              }
          }
    mean_size = known > 0 ? mean_size / known : 0.;

    // Marks of nodes become marks of the boxes around them below.
    std::vector<char> fine_marks(unknown), medium_marks(unknown), coarse_marks(unknown);
    const auto        differs = [&](const std::size_t before,
                             const std::size_t here,
                             const std::size_t after,
                             const double      limit) {
      return unknown[before] != 0 || unknown[after] != 0
             || (values[before] - 2. * values[here] + values[after]).norm() > limit * largest;
    };
    const std::size_t strides[3] = {1, n[0], std::size_t(n[0]) * n[1]};
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          {
            const std::size_t  here  = node(i, j, k);
            const unsigned int at[3] = {i, j, k};
            for (unsigned int d = 0; d < 3; ++d)
              {
                if (at[d] >= 1 && at[d] + 1 < n[d])
                  {
                    if (differs(here - strides[d], here, here + strides[d], levels.fine))
                      fine_marks[here] = 1;
                    if (differs(here - strides[d], here, here + strides[d], levels.medium))
                      medium_marks[here] = 1;
                  }
                if (n[d] <= 2 * FeatureLevels::stride)
                  continue;
                // At the rim of the grid, the differences nearest to it tell.
                const unsigned int center
                  = std::clamp(at[d], FeatureLevels::stride, n[d] - 1 - FeatureLevels::stride);
                const std::size_t there = here + center * strides[d] - at[d] * strides[d];
                if (differs(there - FeatureLevels::stride * strides[d],
                            there,
                            there + FeatureLevels::stride * strides[d],
                            levels.coarse))
                  coarse_marks[here] = 1;
              }
          }
    fine   = MarkCounts(n, fine_marks);
    medium = MarkCounts(n, medium_marks);
    coarse = MarkCounts(n, coarse_marks);
  }

  std::vector<char>
  FeatureGrid::nodes_in(const ForEachCell &cells) const
  {
    std::vector<char> inside(std::size_t(n[0]) * n[1] * n[2], 0);
    bool              any = false;
    cells([&](const std::array<Point<3>, 4> &corners) {
      unsigned int first[3], last[3];
      for (unsigned int d = 0; d < 3; ++d)
        {
          const auto [low, high]
            = std::minmax({corners[0][d], corners[1][d], corners[2][d], corners[3][d]});
          first[d] = static_cast<unsigned int>(
            std::clamp(std::ceil((low - origin[d]) / used_step), 0., n[d] - 1.));
          last[d] = static_cast<unsigned int>(
            std::clamp(std::floor((high - origin[d]) / used_step), 0., n[d] - 1.));
        }
      // Outward normals, for the sides of the faces.
      constexpr unsigned int faces[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
      Tensor<1, 3>           normals[4];
      for (unsigned int f = 0; f < 4; ++f)
        {
          const Point<3> &a = corners[faces[f][0]];
          normals[f]        = cross_product_3d(corners[faces[f][1]] - a, corners[faces[f][2]] - a);
          if (normals[f] * (corners[f] - a) > 0.)
            normals[f] *= -1.;
        }
      for (unsigned int k = first[2]; k <= last[2]; ++k)
        for (unsigned int j = first[1]; j <= last[1]; ++j)
          for (unsigned int i = first[0]; i <= last[0]; ++i)
            {
              const Point<3> x = origin + Point<3>(i * used_step, j * used_step, k * used_step);
              bool           within = true;
              for (unsigned int f = 0; f < 4; ++f)
                within = within && normals[f] * (x - corners[faces[f][0]]) <= 0.;
              if (within)
                {
                  inside[node(i, j, k)] = 1;
                  any                   = true;
                }
            }
    });
    if (!any)
      std::fill(inside.begin(), inside.end(), 1);
    return inside;
  }

  double
  FeatureGrid::part_size(const Point<3> &lower, const Point<3> &upper) const
  {
    std::array<unsigned int, 3> first, last;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const double from = std::floor((lower[d] - origin[d]) / used_step);
        const double to   = std::ceil((upper[d] - origin[d]) / used_step);
        if (!(from >= 0.) || !(to < n[d]))
          return levels.fine_parts * used_step;
        first[d] = static_cast<unsigned int>(from);
        last[d]  = static_cast<unsigned int>(to);
      }
    return fine.any(first, last)     ? levels.fine_parts * used_step
           : medium.any(first, last) ? levels.medium_parts * used_step
           : coarse.any(first, last, FeatureLevels::stride)
             ? levels.coarse_parts * used_step
             : std::numeric_limits<double>::infinity();
  }
} // namespace tetradapt::mechanics
