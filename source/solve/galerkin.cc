// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/galerkin.h"

#include "tetradapt/core/clones.h"

#include <algorithm>
#include <type_traits>

namespace tetradapt::solve
{
  namespace
  {
    /** Appends rows to a BlockRows, adding up what falls on the same column. */
    template <unsigned int n, unsigned int m>
    class RowBuilder
    {
    public:
      RowBuilder(BlockRows<n, m> &rows, unsigned int n_columns)
        : rows(rows), position(n_columns, ~std::size_t(0))
      {
      }
      /** The block of the present row in @p column, zero when first asked for. */
      typename BlockRows<n, m>::Block &
      block(unsigned int column)
      {
        std::size_t &k = position[column];
        if (k >= rows.columns.size() || k < rows.begin.back())
          {
            k = rows.columns.size();
            rows.columns.push_back(column);
            rows.blocks.emplace_back();
            rows.blocks.back().fill(0.);
          }
        return rows.blocks[k];
      }
      void
      end_row()
      {
        rows.begin.push_back(rows.columns.size());
      }

    private:
      BlockRows<n, m>         &rows;
      std::vector<std::size_t> position;
    };

    /** c += a b, with a n x n and b n x 6. */
    template <unsigned int n>
    TETRADAPT_INLINE void
    multiply(const double *__restrict a, const double *__restrict b, double *__restrict c)
    {
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int j = 0; j < 6; ++j)
            c[6 * i + j] += a[n * i + k] * b[6 * k + j];
    }

    /** c += a^T b, with a n x 6 and b n x 6. */
    template <unsigned int n>
    TETRADAPT_INLINE void
    multiply_transposed(const double *__restrict a,
                        const double *__restrict b,
                        double *__restrict c)
    {
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int j = 0; j < 6; ++j)
            c[6 * i + j] += a[6 * k + i] * b[6 * k + j];
    }

// Clones cannot be made of templates.
#define TETRADAPT_PRODUCTS(n)                                                                      \
  TETRADAPT_CLONES void add_product(std::integral_constant<unsigned int, n>,                       \
                                    const double *a,                                               \
                                    const double *b,                                               \
                                    double       *c)                                               \
  {                                                                                                \
    multiply<n>(a, b, c);                                                                          \
  }                                                                                                \
  TETRADAPT_CLONES void add_transposed_product(std::integral_constant<unsigned int, n>,            \
                                               const double *a,                                    \
                                               const double *b,                                    \
                                               double       *c)                                    \
  {                                                                                                \
    multiply_transposed<n>(a, b, c);                                                               \
  }
    TETRADAPT_PRODUCTS(3)
    TETRADAPT_PRODUCTS(6)

    template <unsigned int n>
    bool
    is_zero(const std::array<double, n * n> &block)
    {
      return std::all_of(block.begin(), block.end(), [](double entry) { return entry == 0.; });
    }
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
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      {
        for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
          {
            const unsigned int node = matrix.columns[k], column = tentative.aggregates[node];
            if (column != no_aggregate && !is_zero<n>(matrix.blocks[k]))
              add_product(std::integral_constant<unsigned int, n>(),
                          matrix.blocks[k].data(),
                          tentative.rows[node].data(),
                          builder.block(column).data());
          }
        auto factors = inverse_diagonal[row];
        for (double &factor : factors)
          factor *= -omega;
        for (std::size_t k = P.begin.back(); k < P.columns.size(); ++k)
          {
            const auto sum = P.blocks[k];
            P.blocks[k].fill(0.);
            add_product(std::integral_constant<unsigned int, n>(),
                        factors.data(),
                        sum.data(),
                        P.blocks[k].data());
          }
        if (tentative.aggregates[row] != no_aggregate)
          {
            auto &own = builder.block(tentative.aggregates[row]);
            for (unsigned int i = 0; i < own.size(); ++i)
              own[i] += tentative.rows[row][i];
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
    BlockRows<n, 6>  product; // A P
    RowBuilder<n, 6> product_builder(product, n_aggregates);
    product.columns.reserve(2 * prolongation.columns.size());
    product.blocks.reserve(2 * prolongation.columns.size());
    std::vector<std::size_t> begin(n_aggregates + 1, 0); // P^T: where in P's arrays
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      {
        for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
          if (!is_zero<n>(matrix.blocks[k]))
            {
              const unsigned int node = matrix.columns[k];
              for (std::size_t l = prolongation.begin[node]; l < prolongation.begin[node + 1]; ++l)
                add_product(std::integral_constant<unsigned int, n>(),
                            matrix.blocks[k].data(),
                            prolongation.blocks[l].data(),
                            product_builder.block(prolongation.columns[l]).data());
            }
        product_builder.end_row();
        for (std::size_t l = prolongation.begin[row]; l < prolongation.begin[row + 1]; ++l)
          ++begin[prolongation.columns[l] + 1];
      }
    for (unsigned int i = 0; i < n_aggregates; ++i)
      begin[i + 1] += begin[i];
    std::vector<std::array<std::size_t, 2>> transposed(begin.back()); // row, entry
    auto                                    next = begin;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      for (std::size_t l = prolongation.begin[row]; l < prolongation.begin[row + 1]; ++l)
        transposed[next[prolongation.columns[l]]++] = {{row, l}};

    BlockRows<6, 6>  coarse;
    RowBuilder<6, 6> builder(coarse, n_aggregates);
    for (unsigned int i = 0; i < n_aggregates; ++i)
      {
        for (std::size_t k = begin[i]; k < begin[i + 1]; ++k)
          {
            const auto [row, l] = transposed[k];
            for (std::size_t m = product.begin[row]; m < product.begin[row + 1]; ++m)
              add_transposed_product(std::integral_constant<unsigned int, n>(),
                                     prolongation.blocks[l].data(),
                                     product.blocks[m].data(),
                                     builder.block(product.columns[m]).data());
          }
        builder.end_row();
      }
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
  template BlockRows<6, 6>
  galerkin<3>(const BlockRows<3, 3> &, const BlockRows<3, 6> &, unsigned int);
  template BlockRows<6, 6>
  galerkin<6>(const BlockRows<6, 6> &, const BlockRows<6, 6> &, unsigned int);
} // namespace tetradapt::solve
