// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_recovery_polynomial_fit_h
#define tetradapt_estimate_recovery_polynomial_fit_h

#include "tetradapt/core/clones.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  /** Numbers of monomials in three variables up to degree 0, 1 and 2. */
  constexpr unsigned int n_monomials[3] = {1, 4, 10};

  /** 1, x, y, z, x^2, y^2, z^2, xy, yz, zx up to degree @p degree (at most 2).
   * @tparam Number double, or several numbers together (core::Lanes). */
  template <unsigned int degree, typename Number>
  TETRADAPT_INLINE void
  monomials(const Number x, const Number y, const Number z, Number *m)
  {
    m[0] = Number{} + 1.;
    if (degree >= 1)
      {
        m[1] = x;
        m[2] = y;
        m[3] = z;
      }
    if (degree >= 2)
      {
        m[4] = x * x;
        m[5] = y * y;
        m[6] = z * z;
        m[7] = x * y;
        m[8] = y * z;
        m[9] = z * x;
      }
  }

  /**
   * Cholesky's factor of a symmetric positive matrix whose rows and columns are
   * scaled to a diagonal of ones. Lower triangle, row by row, @p n columns a row.
   *
   * @param smallest_pivot a pivot is the squared sine of the angle between a column
   *        and the space of those before it; below, nothing is determined well.
   * @return false if a pivot is too small; then @p matrix holds nothing of use.
   */
  template <unsigned int n>
  TETRADAPT_INLINE bool
  factorize(double (&matrix)[n][n], double (&scale)[n], const double smallest_pivot)
  {
    for (unsigned int i = 0; i < n; ++i)
      {
        if (!(matrix[i][i] > 0.))
          return false;
        scale[i] = 1. / std::sqrt(matrix[i][i]);
      }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        matrix[i][j] *= scale[i] * scale[j];
    double column[n];
    for (unsigned int k = 0; k < n; ++k)
      {
        if (!(matrix[k][k] > smallest_pivot))
          return false;
        const double root = std::sqrt(matrix[k][k]), factor = 1. / root;
        matrix[k][k] = root;
        for (unsigned int i = k + 1; i < n; ++i)
          column[i] = matrix[i][k] *= factor;
        for (unsigned int i = k + 1; i < n; ++i)
          {
            const double f = column[i];
            for (unsigned int j = k + 1; j <= i; ++j)
              matrix[i][j] -= f * column[j];
          }
      }
    return true;
  }

  /** Solves with what factorize() left; @p x holds the right-hand side, then the
   * solution. */
  template <unsigned int n>
  TETRADAPT_INLINE void
  solve_factorized(const double (&matrix)[n][n], const double (&scale)[n], double *x)
  {
    for (unsigned int i = 0; i < n; ++i)
      {
        double sum = x[i] * scale[i];
        for (unsigned int k = 0; k < i; ++k)
          sum -= matrix[i][k] * x[k];
        x[i] = sum / matrix[i][i];
      }
    for (unsigned int i = n; i-- > 0;)
      {
        x[i] /= matrix[i][i];
        const double f = x[i];
        for (unsigned int k = 0; k < i; ++k)
          x[k] -= matrix[i][k] * f;
      }
    for (unsigned int i = 0; i < n; ++i)
      x[i] *= scale[i];
  }
} // namespace tetradapt::estimate

#endif
