// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_dense_cholesky_h
#define tetradapt_source_solve_dense_cholesky_h

#include "tetradapt/solve/block_rows.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::solve
{
  /** A small matrix of 6 x 6 blocks, factorised. Unknowns whose pivot vanishes to
   * rounding are left at zero. */
  class DenseCholesky
  {
  public:
    explicit DenseCholesky(const BlockRows<6, 6> &matrix)
      : n(6 * matrix.n_rows()), U(n * n, 0.), inverse_pivots(n, 0.)
    {
      for (std::size_t row = 0; row < matrix.n_rows(); ++row)
        for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
          for (unsigned int i = 0; i < 36; ++i)
            U[(6 * row + i / 6) * n + 6 * std::size_t(matrix.columns[k]) + i % 6]
              = matrix.blocks[k][i];
      // Row p of U^T U = A, then what it takes from the rows below.
      for (std::size_t p = 0; p < n; ++p)
        {
          double *row = &U[p * n];
          if (!(row[p] > 1e-13 * matrix_diagonal(matrix, p)))
            {
              std::fill(row + p, row + n, 0.);
              continue;
            }
          inverse_pivots[p] = 1. / std::sqrt(row[p]);
          for (std::size_t j = p; j < n; ++j)
            row[j] *= inverse_pivots[p];
          for (std::size_t i = p + 1; i < n; ++i)
            if (row[i] != 0.)
              {
                double *__restrict below = &U[i * n];
                const double factor      = row[i];
                for (std::size_t j = i; j < n; ++j)
                  below[j] -= factor * row[j];
              }
        }
    }

    /** x becomes the solution for the right-hand side x. */
    template <typename Number>
    void
    solve(Number *x) const
    {
      std::vector<double> y(x, x + n);
      for (std::size_t p = 0; p < n; ++p)
        {
          y[p] *= inverse_pivots[p];
          const double  value = y[p];
          const double *row   = &U[p * n];
          for (std::size_t j = p + 1; j < n; ++j)
            y[j] -= value * row[j];
        }
      for (std::size_t p = n; p-- > 0;)
        {
          const double *row    = &U[p * n];
          double        sum[4] = {};
          std::size_t   j      = p + 1;
          for (; j + 4 <= n; j += 4)
            for (unsigned int l = 0; l < 4; ++l)
              sum[l] += row[j + l] * y[j + l];
          for (; j < n; ++j)
            sum[0] += row[j] * y[j];
          y[p] = (y[p] - ((sum[0] + sum[1]) + (sum[2] + sum[3]))) * inverse_pivots[p];
          x[p] = static_cast<Number>(y[p]);
        }
    }

  private:
    static double
    matrix_diagonal(const BlockRows<6, 6> &matrix, std::size_t p)
    {
      for (std::size_t k = matrix.begin[p / 6]; k < matrix.begin[p / 6 + 1]; ++k)
        if (matrix.columns[k] == p / 6)
          return matrix.blocks[k][7 * (p % 6)];
      return 0.;
    }

    std::size_t         n;
    std::vector<double> U; ///< upper triangle, row by row
    std::vector<double> inverse_pivots;
  };
} // namespace tetradapt::solve

#endif
