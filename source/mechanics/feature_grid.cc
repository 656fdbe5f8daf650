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
    /** Second differences, relative to the largest value, above which a function varies fast.
     * A bell curve exp(-r^2 / (2 s^2)) has the step over s, squared, at its top: it is seen by
     * one step up to s = 4.5 steps, by four steps up to s = 10 steps. */
    constexpr double       fast = 0.05, rather_fast = 0.15;
    constexpr unsigned int stride = 4;
  } // namespace

  FeatureGrid::FeatureGrid(const std::function<Tensor<1, 3>(const Point<3> &)> &function,
                           const Point<3>                                      &lower,
                           const Point<3>                                      &upper,
                           const double                                         step,
                           const std::size_t                                    most_nodes)
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
                largest                  = std::max(largest, size);
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
    std::vector<char> fine_marks(unknown), coarse_marks(unknown);
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
                if (at[d] >= 1 && at[d] + 1 < n[d]
                    && differs(here - strides[d], here, here + strides[d], fast))
                  fine_marks[here] = 1;
                if (n[d] <= 2 * stride)
                  continue;
                // At the rim of the grid, the differences nearest to it tell.
                const unsigned int center = std::clamp(at[d], stride, n[d] - 1 - stride);
                const std::size_t  there  = here + center * strides[d] - at[d] * strides[d];
                if (differs(
                      there - stride * strides[d], there, there + stride * strides[d], rather_fast))
                  coarse_marks[here] = 1;
              }
          }
    fine   = count(fine_marks);
    coarse = count(coarse_marks);
  }

  FeatureGrid::Counts
  FeatureGrid::count(const std::vector<char> &marked) const
  {
    Counts counts(marked.size());
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        {
          unsigned int row = 0;
          for (unsigned int i = 0; i < n[0]; ++i)
            {
              row += marked[node(i, j, k)] != 0;
              unsigned int sum = row;
              if (j > 0)
                sum += counts[node(i, j - 1, k)];
              if (k > 0)
                sum += counts[node(i, j, k - 1)];
              if (j > 0 && k > 0)
                sum -= counts[node(i, j - 1, k - 1)];
              counts[node(i, j, k)] = sum;
            }
        }
    return counts;
  }

  bool
  FeatureGrid::any(const Counts                      &counts,
                   const std::array<unsigned int, 3> &first,
                   const std::array<unsigned int, 3> &last) const
  {
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
          sum += negative ? -counts[node(at[0], at[1], at[2])] : counts[node(at[0], at[1], at[2])];
      }
    return sum != 0;
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
          return used_step;
        first[d] = static_cast<unsigned int>(from);
        last[d]  = static_cast<unsigned int>(to);
      }
    return any(fine, first, last)     ? used_step
           : any(coarse, first, last) ? stride * used_step
                                      : std::numeric_limits<double>::infinity();
  }

  std::size_t
  FeatureGrid::n_fine_boxes() const
  {
    return fine.empty() ? 0 : fine.back();
  }
} // namespace tetradapt::mechanics
