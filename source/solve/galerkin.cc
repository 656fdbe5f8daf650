// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/galerkin.h"

#include "row_builder.h"

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    /** c += a b, with a n x n and b n x 6. */
    template <unsigned int n>
    TETRADAPT_INLINE void
    multiply(const double *a, const double *b, double *c)
    {
#pragma GCC unroll 6
      for (unsigned int i = 0; i < n; ++i)
        {
          double sums[6];
          for (unsigned int j = 0; j < 6; ++j)
            sums[j] = c[6 * i + j];
#pragma GCC unroll 6
          for (unsigned int k = 0; k < n; ++k)
            for (unsigned int j = 0; j < 6; ++j)
              sums[j] += a[n * i + k] * b[6 * k + j];
          for (unsigned int j = 0; j < 6; ++j)
            c[6 * i + j] = sums[j];
        }
    }

    /** c += a^T b, with a n x 6 and b n x 6. */
    template <unsigned int n>
    TETRADAPT_INLINE void
    multiply_transposed(const double *a, const double *b, double *c)
    {
      for (unsigned int i = 0; i < 6; ++i)
        {
          double sums[6];
          for (unsigned int j = 0; j < 6; ++j)
            sums[j] = c[6 * i + j];
#pragma GCC unroll 6
          for (unsigned int k = 0; k < n; ++k)
            for (unsigned int j = 0; j < 6; ++j)
              sums[j] += a[6 * k + i] * b[6 * k + j];
          for (unsigned int j = 0; j < 6; ++j)
            c[6 * i + j] = sums[j];
        }
    }

    template <unsigned int n>
    TETRADAPT_INLINE bool
    is_zero(const std::array<double, n * n> &block)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < n * n; ++i)
        sum += block[i] != 0. ? 1. : 0.;
      return sum == 0.;
    }

    template <unsigned int n>
    TETRADAPT_INLINE void
    smooth_rows(const BlockRows<n, n>                        &matrix,
                const std::vector<std::array<double, n * n>> &inverse_diagonal,
                const LocalTentative<n>                      &tentative,
                double                                        omega,
                BlockRows<n, 6>                              &P,
                RowBuilder<n, 6>                             &builder)
    {
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        {
          for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
            {
              const unsigned int node = matrix.columns[k], column = tentative.aggregates[node];
              if (column != no_aggregate && !is_zero<n>(matrix.blocks[k]))
                multiply<n>(matrix.blocks[k].data(),
                            tentative.rows[node].data(),
                            builder.block(column).data());
            }
          // Not in place: g++ 12 made wrong code for AVX-512 of a copy, zeros and sums
          // (tests/solve/galerkin.cc compares with dense matrices).
          const auto &inverse = inverse_diagonal[row];
          for (std::size_t k = P.begin.back(); k < P.columns.size(); ++k)
            {
              double result[6 * n] = {};
              multiply<n>(inverse.data(), P.blocks[k].data(), result);
              for (unsigned int i = 0; i < 6 * n; ++i)
                P.blocks[k][i] = -omega * result[i];
            }
          if (tentative.aggregates[row] != no_aggregate)
            {
              auto &own = builder.block(tentative.aggregates[row]);
              for (unsigned int i = 0; i < own.size(); ++i)
                own[i] += tentative.rows[row][i];
            }
          builder.end_row();
        }
    }

    /** The rows of A P. */
    template <unsigned int n>
    TETRADAPT_INLINE void
    multiply_rows(const BlockRows<n, n> &matrix,
                  const BlockRows<n, 6> &prolongation,
                  RowBuilder<n, 6>      &builder)
    {
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        {
          for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
            if (!is_zero<n>(matrix.blocks[k]))
              {
                const unsigned int node = matrix.columns[k];
                for (std::size_t l = prolongation.begin[node]; l < prolongation.begin[node + 1];
                     ++l)
                  multiply<n>(matrix.blocks[k].data(),
                              prolongation.blocks[l].data(),
                              builder.block(prolongation.columns[l]).data());
              }
          builder.end_row();
        }
    }

    /** The entries of a matrix by columns: where a column begins, and row and entry of each. */
    struct Transposed
    {
      template <unsigned int n>
      Transposed(const BlockRows<n, 6> &matrix, unsigned int n_rows, unsigned int n_columns)
        : begin(n_columns + 1, 0)
      {
        const std::size_t size = matrix.begin[n_rows];
        for (std::size_t l = 0; l < size; ++l)
          ++begin[matrix.columns[l] + 1];
        for (unsigned int i = 0; i < n_columns; ++i)
          begin[i + 1] += begin[i];
        entries.resize(size);
        auto next = begin;
        for (unsigned int row = 0; row < n_rows; ++row)
          for (std::size_t l = matrix.begin[row]; l < matrix.begin[row + 1]; ++l)
            entries[next[matrix.columns[l]]++] = {{row, l}};
      }

      std::vector<std::size_t>                begin;
      std::vector<std::array<std::size_t, 2>> entries;
    };

    /** The rows of P^T (A P). */
    template <unsigned int n>
    TETRADAPT_INLINE void
    multiply_transposed_rows(const Transposed      &transposed,
                             const BlockRows<n, 6> &prolongation,
                             const BlockRows<n, 6> &product,
                             RowBuilder<6, 6>      &builder)
    {
      for (unsigned int i = 0; i + 1 < transposed.begin.size(); ++i)
        {
          for (std::size_t k = transposed.begin[i]; k < transposed.begin[i + 1]; ++k)
            {
              const auto [row, l] = transposed.entries[k];
              for (std::size_t m = product.begin[row]; m < product.begin[row + 1]; ++m)
                multiply_transposed<n>(prolongation.blocks[l].data(),
                                       product.blocks[m].data(),
                                       builder.block(product.columns[m]).data());
            }
          builder.end_row();
        }
    }

// Clones cannot be made of templates.
#define TETRADAPT_PRODUCTS(n)                                                                      \
  TETRADAPT_CLONES void smooth_all(const BlockRows<n, n>                        &matrix,           \
                                   const std::vector<std::array<double, n * n>> &inverse_diagonal, \
                                   const LocalTentative<n>                      &tentative,        \
                                   double                                        omega,            \
                                   BlockRows<n, 6>                              &P,                \
                                   RowBuilder<n, 6>                             &builder)          \
  {                                                                                                \
    smooth_rows<n>(matrix, inverse_diagonal, tentative, omega, P, builder);                        \
  }                                                                                                \
  TETRADAPT_CLONES void multiply_all(const BlockRows<n, n> &matrix,                                \
                                     const BlockRows<n, 6> &prolongation,                          \
                                     RowBuilder<n, 6>      &builder)                               \
  {                                                                                                \
    multiply_rows<n>(matrix, prolongation, builder);                                               \
  }                                                                                                \
  TETRADAPT_CLONES void multiply_all_transposed(const Transposed      &transposed,                 \
                                                const BlockRows<n, 6> &prolongation,               \
                                                const BlockRows<n, 6> &product,                    \
                                                RowBuilder<6, 6>      &builder)                    \
  {                                                                                                \
    multiply_transposed_rows<n>(transposed, prolongation, product, builder);                       \
  }
    TETRADAPT_PRODUCTS(3)
    TETRADAPT_PRODUCTS(6)
  } // namespace

  template <unsigned int n>
  BlockRows<n, 6>
  smooth(const BlockRows<n, n>                        &matrix,
         const std::vector<std::array<double, n * n>> &inverse_diagonal,
         const LocalTentative<n>                      &tentative,
         unsigned int                                  n_aggregates,
         double                                        omega)
  {
    BlockRows<n, 6>  P;
    RowBuilder<n, 6> builder(P, n_aggregates);
    P.columns.reserve(4 * std::size_t(matrix.n_rows()));
    P.blocks.reserve(4 * std::size_t(matrix.n_rows()));
    smooth_all(matrix, inverse_diagonal, tentative, omega, P, builder);
    return P;
  }

  template <unsigned int n>
  BlockRows<n, 6>
  smooth_further(const BlockRows<n, n>                        &matrix,
                 const std::vector<std::array<double, n * n>> &inverse_diagonal,
                 const BlockRows<n, 6>                        &prolongation,
                 unsigned int                                  n_aggregates,
                 double                                        omega)
  {
    BlockRows<n, 6>  product;
    RowBuilder<n, 6> product_builder(product, n_aggregates);
    multiply_all(matrix, prolongation, product_builder);
    BlockRows<n, 6>  P;
    RowBuilder<n, 6> builder(P, n_aggregates);
    P.columns.reserve(product.columns.size());
    P.blocks.reserve(product.columns.size());
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      {
        for (std::size_t k = product.begin[row]; k < product.begin[row + 1]; ++k)
          {
            double result[6 * n] = {};
            multiply<n>(inverse_diagonal[row].data(), product.blocks[k].data(), result);
            auto &block = builder.block(product.columns[k]);
            for (unsigned int i = 0; i < 6 * n; ++i)
              block[i] = -omega * result[i];
          }
        for (std::size_t k = prolongation.begin[row]; k < prolongation.begin[row + 1]; ++k)
          {
            auto &block = builder.block(prolongation.columns[k]);
            for (unsigned int i = 0; i < 6 * n; ++i)
              block[i] += prolongation.blocks[k][i];
          }
        builder.end_row();
      }
    return P;
  }

  template <unsigned int n>
  BlockRows<6, 6>
  galerkin(const BlockRows<n, n> &matrix,
           const BlockRows<n, 6> &prolongation,
           unsigned int           n_aggregates)
  {
    BlockRows<n, 6>  product;
    RowBuilder<n, 6> product_builder(product, n_aggregates);
    product.columns.reserve(2 * prolongation.columns.size());
    product.blocks.reserve(2 * prolongation.columns.size());
    multiply_all(matrix, prolongation, product_builder);

    BlockRows<6, 6>  coarse;
    RowBuilder<6, 6> builder(coarse, n_aggregates);
    multiply_all_transposed(Transposed(prolongation, matrix.n_rows(), n_aggregates),
                            prolongation,
                            product,
                            builder);
    return coarse;
  }

  template BlockRows<3, 6>
  smooth<3>(const BlockRows<3, 3> &,
            const std::vector<std::array<double, 9>> &,
            const LocalTentative<3> &,
            unsigned int,
            double);
  template BlockRows<6, 6>
  smooth<6>(const BlockRows<6, 6> &,
            const std::vector<std::array<double, 36>> &,
            const LocalTentative<6> &,
            unsigned int,
            double);
  template BlockRows<3, 6>
  smooth_further<3>(const BlockRows<3, 3> &,
                    const std::vector<std::array<double, 9>> &,
                    const BlockRows<3, 6> &,
                    unsigned int,
                    double);
  template BlockRows<6, 6>
  smooth_further<6>(const BlockRows<6, 6> &,
                    const std::vector<std::array<double, 36>> &,
                    const BlockRows<6, 6> &,
                    unsigned int,
                    double);
  template BlockRows<6, 6>
  galerkin<3>(const BlockRows<3, 3> &, const BlockRows<3, 6> &, unsigned int);
  template BlockRows<6, 6>
  galerkin<6>(const BlockRows<6, 6> &, const BlockRows<6, 6> &, unsigned int);
} // namespace tetradapt::solve
