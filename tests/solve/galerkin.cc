// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Smoothed prolongation and coarse matrix, which are compiled for several processors,
// against the same products of dense matrices, number by number.

#include "tetradapt/solve/galerkin.h"

#include <cmath>
#include <iostream>

using namespace tetradapt;

namespace
{
  using Dense = std::vector<std::vector<double>>;

  double
  next_value()
  {
    static unsigned long seed = 7;
    seed                      = (seed * 1103515245ul + 12345ul) % 2147483648ul;
    return seed / 1073741824. - 1.;
  }

  template <std::size_t size>
  void
  fill(std::array<double, size> &block)
  {
    for (double &entry : block)
      entry = next_value();
  }

  Dense
  product(const Dense &a, const Dense &b)
  {
    Dense c(a.size(), std::vector<double>(b[0].size(), 0.));
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t k = 0; k < b.size(); ++k)
        for (std::size_t j = 0; j < b[0].size(); ++j)
          c[i][j] += a[i][k] * b[k][j];
    return c;
  }

  Dense
  transposed(const Dense &a)
  {
    Dense t(a[0].size(), std::vector<double>(a.size()));
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < a[0].size(); ++j)
        t[j][i] = a[i][j];
    return t;
  }

  template <unsigned int n, unsigned int m>
  Dense
  dense(const solve::BlockRows<n, m> &rows, unsigned int n_columns)
  {
    Dense a(n * rows.n_rows(), std::vector<double>(m * n_columns, 0.));
    for (unsigned int row = 0; row < rows.n_rows(); ++row)
      for (std::size_t k = rows.begin[row]; k < rows.begin[row + 1]; ++k)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < m; ++j)
            a[n * row + i][m * rows.columns[k] + j] += rows.blocks[k][m * i + j];
    return a;
  }

  void
  compare(const std::string &label, const Dense &a, const Dense &b)
  {
    double difference = 0., largest = 0.;
    bool   same_size = a.size() == b.size() && a[0].size() == b[0].size();
    for (std::size_t i = 0; same_size && i < a.size(); ++i)
      for (std::size_t j = 0; j < a[0].size(); ++j)
        {
          difference = std::max(difference, std::abs(a[i][j] - b[i][j]));
          largest    = std::max(largest, std::abs(b[i][j]));
        }
    std::cout << label << ": "
              << (same_size && largest > 0. && difference < 1e-13 * largest ? "same" : "DIFFERENT")
              << '\n';
  }

  /** A ring of nodes, each coupled with itself and three others; one coupling is zero and one
   * node is in no aggregate. */
  template <unsigned int n>
  void
  ring(unsigned int n_nodes)
  {
    solve::BlockRows<n, n>                 matrix;
    std::vector<std::array<double, n * n>> inverses(n_nodes);
    solve::LocalTentative<n>               tentative;
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        for (const unsigned int step : {0u, 1u, n_nodes - 1, 5u})
          {
            matrix.columns.push_back((node + step) % n_nodes);
            matrix.blocks.emplace_back();
            fill(matrix.blocks.back());
          }
        matrix.begin.push_back(matrix.columns.size());
        fill(inverses[node]);
        tentative.aggregates.push_back(node == 2 ? solve::no_aggregate : node / 4);
        tentative.rows.emplace_back();
        fill(tentative.rows.back());
      }
    matrix.blocks[5].fill(0.);
    const unsigned int n_aggregates = (n_nodes + 3) / 4;
    const double       omega        = 0.7;
    const auto         P      = solve::smooth<n>(matrix, inverses, tentative, n_aggregates, omega);
    const auto         coarse = solve::galerkin<n>(matrix, P, n_aggregates);

    Dense T(n * n_nodes, std::vector<double>(6 * n_aggregates, 0.)),
      D(n * n_nodes, std::vector<double>(n * n_nodes, 0.));
    for (unsigned int node = 0; node < n_nodes; ++node)
      for (unsigned int i = 0; i < n; ++i)
        {
          for (unsigned int j = 0; j < n; ++j)
            D[n * node + i][n * node + j] = inverses[node][n * i + j];
          for (unsigned int j = 0; node != 2 && j < 6; ++j)
            T[n * node + i][6 * (node / 4) + j] = tentative.rows[node][6 * i + j];
        }
    const Dense A        = dense(matrix, n_nodes);
    Dense       expected = product(D, product(A, T));
    for (std::size_t i = 0; i < expected.size(); ++i)
      for (std::size_t j = 0; j < expected[0].size(); ++j)
        expected[i][j] = T[i][j] - omega * expected[i][j];
    compare("prolongation", dense(P, n_aggregates), expected);
    compare("coarse matrix",
            dense(coarse, n_aggregates),
            product(transposed(expected), product(A, expected)));
  }
} // namespace

int
main()
{
  for (const unsigned int n_nodes : {7u, 31u})
    {
      ring<3>(n_nodes);
      ring<6>(n_nodes);
    }
}
