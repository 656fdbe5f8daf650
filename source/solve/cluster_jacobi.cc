// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/cluster_jacobi.h"

#include "tetradapt/core/clones.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::solve
{
  namespace
  {
    /** The inverse of a symmetric positive matrix of @p n rows by Cholesky's factorisation.
     * Unknowns whose pivot vanishes to rounding get zero rows and columns. */
    std::vector<double>
    inverse_of(std::vector<double> A, const std::size_t n)
    {
      std::vector<double> L_inverse(n * n, 0.), diagonal(n);
      for (std::size_t i = 0; i < n; ++i)
        diagonal[i] = A[i * n + i];
      for (std::size_t p = 0; p < n; ++p)
        {
          const bool   is_positive = A[p * n + p] > 1e-13 * diagonal[p];
          const double root        = is_positive ? 1. / std::sqrt(A[p * n + p]) : 0.;
          for (std::size_t i = p; i < n; ++i)
            A[i * n + p] *= root;
          for (std::size_t i = p + 1; i < n; ++i)
            for (std::size_t j = p + 1; j <= i; ++j)
              A[i * n + j] -= A[i * n + p] * A[j * n + p];
          // Row p of L^-1 follows from the rows above.
          L_inverse[p * n + p] = root;
          for (std::size_t k = 0; k < p; ++k)
            for (std::size_t j = 0; j <= k; ++j)
              L_inverse[p * n + j] -= root * A[p * n + k] * L_inverse[k * n + j];
        }
      std::vector<double> inverse(n * n, 0.);
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i <= k; ++i)
          for (std::size_t j = 0; j <= k; ++j)
            inverse[i * n + j] += L_inverse[k * n + i] * L_inverse[k * n + j];
      return inverse;
    }

    /** z = factor M s with a symmetric matrix of @p n rows. */
    template <typename Number>
    TETRADAPT_INLINE void
    multiply(std::size_t n, const Number *__restrict M, const Number *s, Number *__restrict z)
    {
      std::fill(z, z + n, Number(0));
      for (std::size_t j = 0; j < n; ++j, M += n)
        {
          const Number value = s[j];
          for (std::size_t i = 0; i < n; ++i)
            z[i] += M[i] * value;
        }
    }

// Clones cannot be made of templates.
#define TETRADAPT_MULTIPLY(Number)                                                                 \
  TETRADAPT_CLONES void multiply_cluster(std::size_t   n,                                          \
                                         const Number *M,                                          \
                                         const Number *s,                                          \
                                         Number       *z)                                          \
  {                                                                                                \
    multiply<Number>(n, M, s, z);                                                                  \
  }
    TETRADAPT_MULTIPLY(float)
    TETRADAPT_MULTIPLY(double)
  } // namespace

  template <typename Number>
  ClusterJacobi<Number>::ClusterJacobi(const BlockRows<3, 3> &rows,
                                       const Aggregates      &clusters,
                                       const double           scale)
  {
    std::vector<std::vector<unsigned int>> members(clusters.count);
    for (unsigned int node = 0; node < clusters.of_node.size(); ++node)
      if (clusters.of_node[node] != no_aggregate)
        members[clusters.of_node[node]].push_back(node);
    std::size_t n_entries = 0;
    for (const auto &cluster : members)
      if (cluster.size() > 1)
        {
          nodes.insert(nodes.end(), cluster.begin(), cluster.end());
          begin.push_back(nodes.size());
          n_entries += 9 * cluster.size() * cluster.size();
          largest = std::max(largest, 3 * static_cast<unsigned int>(cluster.size()));
        }
    inverses.reserve(n_entries);
    for (std::size_t c = 0; c + 1 < begin.size(); ++c)
      append_inverse(rows, c, scale);
  }

  template <typename Number>
  void
  ClusterJacobi<Number>::append_inverse(const BlockRows<3, 3> &rows,
                                        const std::size_t      cluster,
                                        const double           scale)
  {
    const auto          first = nodes.begin() + begin[cluster];
    const auto          last  = nodes.begin() + begin[cluster + 1];
    const std::size_t   n     = 3 * (last - first);
    std::vector<double> A(n * n, 0.);
    for (auto node = first; node != last; ++node)
      for (std::size_t k = rows.begin[*node]; k < rows.begin[*node + 1]; ++k)
        {
          // Nodes ascend in a cluster.
          const auto column = std::lower_bound(first, last, rows.columns[k]);
          if (column == last || *column != rows.columns[k])
            continue;
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              A[(3 * (node - first) + i) * n + 3 * (column - first) + j]
                = scale * rows.blocks[k][3 * i + j];
        }
    for (const double entry : inverse_of(std::move(A), n))
      inverses.push_back(static_cast<Number>(entry));
  }

  template <typename Number>
  void
  ClusterJacobi<Number>::add(const double factor, const Number *r, Number *d, Number *x) const
  {
    std::vector<Number> s(largest), z(largest);
    const Number       *inverse = inverses.begin();
    for (std::size_t c = 0; c + 1 < begin.size(); ++c)
      {
        const std::size_t n = 3 * (begin[c + 1] - begin[c]);
        for (std::size_t i = 0; i < n; ++i)
          s[i] = static_cast<Number>(factor) * r[3 * std::size_t(nodes[begin[c] + i / 3]) + i % 3];
        multiply_cluster(n, inverse, s.data(), z.data());
        inverse += n * n;
        for (std::size_t i = 0; i < n; ++i)
          {
            const std::size_t unknown = 3 * std::size_t(nodes[begin[c] + i / 3]) + i % 3;
            d[unknown] += z[i];
            x[unknown] += z[i];
          }
      }
  }

  template class ClusterJacobi<float>;
  template class ClusterJacobi<double>;
} // namespace tetradapt::solve
