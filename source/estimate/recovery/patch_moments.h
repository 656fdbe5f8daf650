// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_recovery_patch_moments_h
#define tetradapt_estimate_recovery_patch_moments_h

#include "lane_cholesky.h"
#include "stress_samples.h"

#include "tetradapt/estimate/recovery/polynomial_fit.h"

#include <deal.II/base/aligned_vector.h>

namespace tetradapt::estimate
{
  /** The samples of the cells of a patch, copied side by side: coordinates and stresses. */
  class PatchSamples
  {
  public:
    void
    gather(const StressSamples &samples, const std::vector<unsigned int> &cells);

    unsigned int n_a_cell  = 0;
    unsigned int n_samples = 0;
    /** How many vectors the samples fill; those beyond n_samples that fill the last one
     * are undefined. */
    unsigned int n_batches = 0;

    /** Number @p k (see StressSamples) of all samples, cell by cell. */
    TETRADAPT_INLINE core::Lanes                  *
    lanes(const unsigned int k)
    {
      return reinterpret_cast<core::Lanes *>(begin) + std::size_t(k) * n_batches;
    }
    TETRADAPT_INLINE double *
    row(const unsigned int k)
    {
      return begin + std::size_t(k) * n_batches * core::n_lanes;
    }

  private:
    template <unsigned int n>
    void
    copy(const StressSamples &samples, const std::vector<unsigned int> &cells);

    dealii::AlignedVector<double> rows;
    double                       *begin = nullptr; ///< of rows
  };

  /**
   * The normal equations of a least-squares fit of six functions at once (the components of
   * a stress) by polynomials in three variables, in the coordinates (x - center) / length.
   * Eight samples are worked on together. To be used within functions that are compiled
   * for wide vectors (core/clones.h).
   */
  template <unsigned int degree>
  class PatchMoments
  {
  public:
    static constexpr unsigned int n         = n_monomials[degree];
    static constexpr unsigned int n_vectors = (n + core::n_lanes - 1) / core::n_lanes;

    /** Sums up. @param samples get coordinates relative to @p center. */
    TETRADAPT_INLINE void
    collect(PatchSamples &samples, const double *center)
    {
      set_center(samples, center);
      alignas(64) core::Lanes sums[n_groups * core::n_lanes];
      for (unsigned int i = 0; i < n_groups * core::n_lanes; ++i)
        sums[i] = core::Lanes{};
      for (unsigned int begin = 0; begin < samples.n_batches; begin += block)
        add_block(samples, begin, sums);
      alignas(64) core::Lanes totals[n_groups];
      for (unsigned int g = 0; g < n_groups; ++g)
        totals[g] = sums_of_lanes(sums + core::n_lanes * g);
      const auto *total = reinterpret_cast<const double *>(totals);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          moments[i][j] = moments[j][i] = *total++;
      moments[0][0] = samples.n_samples; // without those that only fill the last batch
      for (unsigned int c = 0; c < 6; ++c)
        for (unsigned int i = 0; i < n; ++i)
          right[c][i] = *total++;
    }

    double length = 1.;   ///< the largest distance from the center
    double scale  = 1.;   ///< 1 / length
    double moments[n][n]; ///< sums of products of two monomials
    double right[6][n];   ///< sums of products of a stress and a monomial

  private:
    /** Batches whose monomials are held at once. */
    static constexpr unsigned int block = 12;

    /** Sums of the different products, in groups of as many as there are lanes. */
    static constexpr unsigned int n_sums   = n * (n + 1) / 2 + 6 * n;
    static constexpr unsigned int n_groups = (n_sums + core::n_lanes - 1) / core::n_lanes;

    /** Makes coordinates relative to @p center and finds the unit of length. */
    TETRADAPT_INLINE void
    set_center(PatchSamples &samples, const double *center)
    {
      // Points that only fill the last batch lie in the centre, without stress.
      for (unsigned int k = 0; k < StressSamples::n_numbers; ++k)
        for (unsigned int i = samples.n_samples; i < samples.n_batches * core::n_lanes; ++i)
          samples.row(k)[i] = k < 3 ? center[k] : 0.;
      core::Lanes squares = {};
      for (unsigned int b = 0; b < samples.n_batches; ++b)
        {
          core::Lanes square = {};
          for (unsigned int d = 0; d < 3; ++d)
            {
              core::Lanes &x = samples.lanes(d)[b];
              x -= center[d];
              square += x * x;
            }
          squares = square > squares ? square : squares;
        }
      double largest = 0.;
      for (unsigned int l = 0; l < core::n_lanes; ++l)
        largest = squares[l] > largest ? squares[l] : largest;
      length = std::sqrt(largest);
      scale  = 1. / length;
    }

    /** Adds the products of the batches from @p begin on. */
    TETRADAPT_INLINE void
    add_block(PatchSamples &samples, const unsigned int begin, core::Lanes *sum)
    {
      alignas(64) core::Lanes m[n][block];
      const unsigned int      size
        = samples.n_batches - begin < block ? samples.n_batches - begin : block;
      for (unsigned int b = 0; b < size; ++b)
        {
          core::Lanes values[n];
          monomials<degree>(scale * samples.lanes(0)[begin + b],
                            scale * samples.lanes(1)[begin + b],
                            scale * samples.lanes(2)[begin + b],
                            values);
          for (unsigned int i = 0; i < n; ++i)
            m[i][b] = values[i];
        }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          add_products(*sum++, m[i], m[j], size);
      for (unsigned int c = 0; c < 6; ++c)
        for (unsigned int i = 0; i < n; ++i)
          add_products(*sum++, samples.lanes(3 + c) + begin, m[i], size);
    }

// g++ 14 takes the part of a block beyond its size, which nobody reads, for uninitialised
// data; setting it to zero would cost 4 % of the estimate.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
    TETRADAPT_INLINE static void
    add_products(core::Lanes       &sum,
                 const core::Lanes *first,
                 const core::Lanes *second,
                 const unsigned int size)
    {
      core::Lanes total = sum;
      for (unsigned int b = 0; b < size; ++b)
        total += first[b] * second[b];
      sum = total;
    }
#pragma GCC diagnostic pop
  };
} // namespace tetradapt::estimate

#endif
