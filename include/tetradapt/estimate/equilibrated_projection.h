// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_projection_h
#define tetradapt_estimate_equilibrated_projection_h

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <vector>

namespace tetradapt::estimate
{
  /**
   * For each point of a rule the coefficients by which a value there enters the
   * polynomial, spanned by the functions, that is nearest in the rule's discrete
   * L2 norm. The rule's weights sum to one.
   */
  template <std::size_t n>
  std::vector<std::array<double, n>>
  least_squares(const std::vector<std::array<double, n>> &functions,
                const std::vector<double>                &weights)
  {
    dealii::FullMatrix<double> products(n, n);
    for (unsigned int q = 0; q < weights.size(); ++q)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          products(i, j) += weights[q] * functions[q][i] * functions[q][j];
    products.gauss_jordan();
    std::vector<std::array<double, n>> result(weights.size());
    for (unsigned int q = 0; q < weights.size(); ++q)
      for (unsigned int i = 0; i < n; ++i)
        {
          result[q][i] = 0.;
          for (unsigned int j = 0; j < n; ++j)
            result[q][i] += products(i, j) * weights[q] * functions[q][j];
        }
    return result;
  }
} // namespace tetradapt::estimate

#endif
