// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/polynomial_fit.h"

#include <cmath>

namespace tetradapt::compare
{
  PolynomialFit::PolynomialFit(const unsigned int degree) : degree(degree), n(n_monomials[degree])
  {
    for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int j = 0; j < n; ++j)
          matrix[i][j] = 0.;
        for (unsigned int c = 0; c < 6; ++c)
          right[i][c] = 0.;
      }
  }

  void
  PolynomialFit::add(const double x, const double y, const double z, const double *values)
  {
    double m[10];
    monomials(degree, x, y, z, m);
    for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int j = 0; j <= i; ++j)
          matrix[i][j] += m[i] * m[j];
        for (unsigned int c = 0; c < 6; ++c)
          right[i][c] += m[i] * values[c];
      }
    ++points;
  }

  bool
  PolynomialFit::solve(double *coefficients)
  {
    // Columns are scaled to length one: then a pivot is the squared sine of the
    // angle between a column and the space of those before it.
    constexpr double smallest_pivot = 1e-6;
    double           scale[10];
    for (unsigned int i = 0; i < n; ++i)
      {
        if (!(matrix[i][i] > 0.))
          return false;
        scale[i] = 1. / std::sqrt(matrix[i][i]);
      }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        {
          double sum = matrix[i][j] * scale[i] * scale[j];
          for (unsigned int k = 0; k < j; ++k)
            sum -= matrix[i][k] * matrix[j][k];
          if (i == j)
            {
              if (!(sum > smallest_pivot))
                return false;
              matrix[i][i] = std::sqrt(sum);
            }
          else
            matrix[i][j] = sum / matrix[j][j];
        }
    for (unsigned int c = 0; c < 6; ++c)
      {
        double y[10];
        for (unsigned int i = 0; i < n; ++i)
          {
            y[i] = right[i][c] * scale[i];
            for (unsigned int k = 0; k < i; ++k)
              y[i] -= matrix[i][k] * y[k];
            y[i] /= matrix[i][i];
          }
        for (unsigned int i = n; i-- > 0;)
          {
            for (unsigned int k = i + 1; k < n; ++k)
              y[i] -= matrix[k][i] * y[k];
            y[i] /= matrix[i][i];
          }
        for (unsigned int i = 0; i < n; ++i)
          coefficients[6 * i + c] = y[i] * scale[i];
      }
    return true;
  }
} // namespace tetradapt::compare
