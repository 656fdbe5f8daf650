// SPDX-License-Identifier: AGPL-3.0-or-later
#include "residual_directions.h"

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    /** Entries that stay in the first cache while several vectors pass. */
    constexpr std::size_t block_size = 1024;

    using Coefficients = std::array<double, ResidualDirections::n_kept>;
    using Vectors      = std::array<const double *, ResidualDirections::n_kept>;

    /** sums[j] += (x, y_j) on this rank. */
    void
    add_products(Coefficients      &sums,
                 const Vector      &x,
                 const Vectors     &y,
                 const unsigned int n_vectors)
    {
      const double *const a = x.begin();
      const std::size_t   n = x.locally_owned_size();
      for (std::size_t begin = 0; begin < n; begin += block_size)
        for (unsigned int j = 0; j < n_vectors; ++j)
          {
            // Four sums, for the compiler may not change the order of one.
            const double     *b   = y[j];
            const std::size_t end = std::min(n, begin + block_size);
            double            part[4]{};
            std::size_t       i = begin;
            for (; i + 4 <= end; i += 4)
              for (unsigned int k = 0; k < 4; ++k)
                part[k] += a[i + k] * b[i + k];
            for (; i < end; ++i)
              part[0] += a[i] * b[i];
            sums[j] += part[0] + part[1] + part[2] + part[3];
          }
    }

    /** x -= sum of factors[j] y_j. */
    void
    subtract(Vector &x, const Coefficients &factors, const Vectors &y, const unsigned int n_vectors)
    {
      double *const     a = x.begin();
      const std::size_t n = x.locally_owned_size();
      for (std::size_t begin = 0; begin < n; begin += block_size)
        for (unsigned int j = 0; j < n_vectors; ++j)
          {
            const double *const b      = y[j];
            const double        factor = factors[j];
            const std::size_t   end    = std::min(n, begin + block_size);
            for (std::size_t i = begin; i < end; ++i)
              a[i] -= factor * b[i];
          }
    }
  } // namespace

  ResidualDirection &
  ResidualDirections::next(const MixedVector &like)
  {
    if (slots.size() <= n_kept && n_valid == slots.size())
      {
        slots.push_back({like, like, like, 0.});
        latest = n_valid++;
        return slots.back();
      }
    latest  = n_valid == 0 ? 0 : (latest + 1) % slots.size();
    n_valid = std::min<unsigned int>(n_valid + 1, slots.size());
    return slots[latest];
  }

  void
  ResidualDirections::orthogonalise()
  {
    ResidualDirection &d = slots[latest];
    // The slots of the others: those before, with the last one before the first.
    std::array<const ResidualDirection *, n_kept> others{};
    const unsigned int                            n_others = n_valid - 1;
    for (unsigned int j = 0; j < n_others; ++j)
      others[j] = &slots[(latest + slots.size() - 1 - j) % slots.size()];
    const auto of_others = [&](MixedVector ResidualDirection::*pair, Vector MixedVector::*part) {
      Vectors result{};
      for (unsigned int j = 0; j < n_others; ++j)
        result[j] = (others[j]->*pair.*part).begin();
      return result;
    };
    Coefficients factors{};
    for (Vector MixedVector::*part : {&MixedVector::u, &MixedVector::p})
      add_products(factors,
                   d.preconditioned_force.*part,
                   of_others(&ResidualDirection::force, part),
                   n_others);
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(factors.data(), n_kept),
                                d.force.u.get_mpi_communicator(),
                                dealii::ArrayView<double>(factors.data(), n_kept));
    for (unsigned int j = 0; j < n_others; ++j)
      factors[j] /= others[j]->square;
    for (MixedVector ResidualDirection::*pair : {&ResidualDirection::direction,
                                                 &ResidualDirection::force,
                                                 &ResidualDirection::preconditioned_force})
      for (Vector MixedVector::*part : {&MixedVector::u, &MixedVector::p})
        subtract(d.*pair.*part, factors, of_others(pair, part), n_others);
    d.square = d.force.u * d.preconditioned_force.u + d.force.p * d.preconditioned_force.p;
  }
} // namespace tetradapt::solve
