// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_recovery_lane_cholesky_h
#define tetradapt_estimate_recovery_lane_cholesky_h

#include "tetradapt/core/clones.h"
#include "tetradapt/core/lanes.h"

#include <cmath>

namespace tetradapt::estimate
{
  /** The sums over the lanes of eight vectors. */
  TETRADAPT_INLINE core::Lanes
                   sums_of_lanes(const core::Lanes *v)
  {
    core::Lanes pairs[4], fours[2];
    for (unsigned int i = 0; i < 4; ++i)
      pairs[i] = __builtin_shufflevector(v[2 * i], v[2 * i + 1], 0, 8, 2, 10, 4, 12, 6, 14)
                 + __builtin_shufflevector(v[2 * i], v[2 * i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    for (unsigned int i = 0; i < 2; ++i)
      fours[i]
        = __builtin_shufflevector(pairs[2 * i], pairs[2 * i + 1], 0, 1, 8, 9, 4, 5, 12, 13)
          + __builtin_shufflevector(pairs[2 * i], pairs[2 * i + 1], 2, 3, 10, 11, 6, 7, 14, 15);
    return __builtin_shufflevector(fours[0], fours[1], 0, 1, 2, 3, 8, 9, 10, 11)
           + __builtin_shufflevector(fours[0], fours[1], 4, 5, 6, 7, 12, 13, 14, 15);
  }

  /**
   * Cholesky's factorisation without roots, L D L^T, of a symmetric positive matrix of some
   * ten rows, which are scaled to a diagonal of ones. L D is kept: a root and a division for
   * every column would be what everything waits for. Columns lie in whole vectors of the processor:
   * eight rows are worked on together, and four columns at once are reduced by all columns before
   * them, so that each number is loaded once for four uses.
   *
   * To be used within functions that are compiled for wide vectors (core/clones.h).
   */
  template <unsigned int n>
  class LaneCholesky
  {
  public:
    static constexpr unsigned int n_vectors = (n + core::n_lanes - 1) / core::n_lanes;
    /** Rows with those that only fill the last vector. */
    static constexpr unsigned int n_rows = n_vectors * core::n_lanes;

    /** All numbers zero. */
    TETRADAPT_INLINE void
    clear()
    {
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int u = 0; u < n_vectors; ++u)
          columns[j][u] = core::Lanes{};
    }

    /** Row @p j and following of column @p j of the matrix belong here; what is above the
     * diagonal has no meaning but must be finite. */
    TETRADAPT_INLINE double *
    column(const unsigned int j)
    {
      return reinterpret_cast<double *>(columns[j]);
    }

    /**
     * @param smallest_pivot a pivot is the squared sine of the angle between a column
     *        and the space of those before it; below, nothing is determined well.
     * @return false if a pivot is too small; then there is nothing of use.
     */
    TETRADAPT_INLINE bool
    factorize(const double smallest_pivot)
    {
      if (!scale_to_ones())
        return false;
      for (unsigned int first = 0; first < n; first += width)
        {
          const unsigned int from = first / core::n_lanes;
          double             factors[n][width];
          for (unsigned int k = 0; k < first; ++k)
            for (unsigned int t = 0; t < width; ++t)
              factors[k][t] = column(k)[first + t] * inverse_pivots[k];
          unsigned int v = from;
          if constexpr (n_vectors > 1)
            for (; v + 1 < n_vectors; v += 2)
              reduce<2>(factors, first, v);
          if (v < n_vectors)
            reduce<1>(factors, first, v);
          for (unsigned int k = first; k < first + width; ++k)
            {
              const double pivot = column(k)[k];
              if (!(pivot > smallest_pivot))
                return false;
              inverse_pivots[k] = 1. / pivot;
              for (unsigned int j = k + 1; j < first + width; ++j)
                {
                  const double factor = column(k)[j] * inverse_pivots[k];
                  for (unsigned int u = from; u < n_vectors; ++u)
                    columns[j][u] -= factor * columns[k][u];
                }
            }
        }
      // Solving then needs no look at where a column begins.
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int i = k / core::n_lanes * core::n_lanes; i <= k; ++i)
          column(k)[i] = 0.;
      return true;
    }

    /** @param x the right-hand side, then the solution; as many numbers as n_rows, those from
     *         n on zero. */
    TETRADAPT_INLINE void
    solve(double *x) const
    {
      auto *vectors = reinterpret_cast<core::Lanes *>(x);
      for (unsigned int i = 0; i < n; ++i)
        x[i] *= scale[i];
      for (unsigned int k = 0; k < n; ++k)
        {
          const double f = x[k] * inverse_pivots[k];
          for (unsigned int u = k / core::n_lanes; u < n_vectors; ++u)
            vectors[u] -= f * columns[k][u];
        }
      for (unsigned int block = n_vectors; block-- > 0;)
        {
          const unsigned int begin         = block * core::n_lanes,
                             end           = std::min(begin + core::n_lanes, n);
          core::Lanes later[core::n_lanes] = {};
          for (unsigned int k = begin; k < end; ++k)
            for (unsigned int u = block + 1; u < n_vectors; ++u)
              later[k - begin] += columns[k][u] * vectors[u];
          vectors[block] -= sums_of_lanes(later);
          for (unsigned int k = end; k-- > begin;)
            {
              const double *numbers = reinterpret_cast<const double *>(columns[k]);
              double        sum     = x[k];
              for (unsigned int i = k + 1; i < end; ++i)
                sum -= numbers[i] * x[i];
              x[k] = sum * inverse_pivots[k];
            }
        }
      for (unsigned int i = 0; i < n; ++i)
        x[i] *= scale[i];
    }

    /** The inverse of the matrix; rows are filled up with zeros. */
    TETRADAPT_INLINE void
    invert(core::Lanes (&inverse)[n][n_vectors]) const
    {
      alignas(64) core::Lanes factor[n][n_vectors]; // the inverse of L
      for (unsigned int i = 0; i < n; ++i)
        {
          for (core::Lanes &lanes : factor[i])
            lanes = core::Lanes{};
          reinterpret_cast<double *>(factor[i])[i] = 1.;
          for (unsigned int k = 0; k < i; ++k)
            {
              const double f = reinterpret_cast<const double *>(columns[k])[i] * inverse_pivots[k];
              for (unsigned int u = 0; u <= i / core::n_lanes; ++u)
                factor[i][u] -= f * factor[k][u];
            }
        }
      alignas(64) double scales[n_rows] = {};
      for (unsigned int i = 0; i < n; ++i)
        scales[i] = scale[i];
      for (unsigned int i = 0; i < n; ++i)
        {
          for (core::Lanes &lanes : inverse[i])
            lanes = core::Lanes{};
          for (unsigned int k = i; k < n; ++k)
            {
              const double f = reinterpret_cast<const double *>(factor[k])[i] * inverse_pivots[k];
              for (unsigned int u = 0; u < n_vectors; ++u)
                inverse[i][u] += f * factor[k][u];
            }
          for (unsigned int u = 0; u < n_vectors; ++u)
            inverse[i][u] *= scale[i] * reinterpret_cast<const core::Lanes *>(scales)[u];
        }
    }

  private:
    /** How many columns are reduced at once. */
    static constexpr unsigned int width = n % 4 == 0 ? 4 : n % 2 == 0 ? 2 : 1;

    TETRADAPT_INLINE bool
    scale_to_ones()
    {
      alignas(64) double scales[n_rows] = {};
      for (unsigned int i = 0; i < n; ++i)
        {
          if (!(column(i)[i] > 0.))
            return false;
          scales[i] = scale[i] = 1. / std::sqrt(column(i)[i]);
        }
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int u = j / core::n_lanes; u < n_vectors; ++u)
          columns[j][u] *= scale[j] * reinterpret_cast<const core::Lanes *>(scales)[u];
      return true;
    }

    /** Subtracts from @p height vectors of the columns from @p first on what those before
     * give, times the factors. */
    template <unsigned int height>
    TETRADAPT_INLINE void
    reduce(const double (&factors)[n][width], const unsigned int first, const unsigned int v)
    {
      alignas(64) core::Lanes sums[width][height];
      for (unsigned int t = 0; t < width; ++t)
        for (unsigned int h = 0; h < height; ++h)
          sums[t][h] = columns[first + t][v + h];
      for (unsigned int k = 0; k < first; ++k)
        for (unsigned int t = 0; t < width; ++t)
          {
            for (unsigned int h = 0; h < height; ++h)
              sums[t][h] -= factors[k][t] * columns[k][v + h];
          }
      for (unsigned int t = 0; t < width; ++t)
        for (unsigned int h = 0; h < height; ++h)
          columns[first + t][v + h] = sums[t][h];
    }

    // Vectors that cross lines of the cache cost several times as much.
    alignas(64) core::Lanes columns[n][n_vectors];
    double scale[n], inverse_pivots[n];
  };
} // namespace tetradapt::estimate

#endif
