// SPDX-License-Identifier: AGPL-3.0-or-later
#include "equations.h"

#include <cmath>

namespace tetradapt::estimate
{
  using dealii::Tensor;

  namespace
  {
    /** Component number of a symmetric tensor's entries. */
    constexpr unsigned int component[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};

    double
    dot(const std::vector<double> &a, const std::vector<double> &b)
    {
      double sum = 0.;
      for (std::size_t k = 0; k < a.size(); ++k)
        sum += a[k] * b[k];
      return sum;
    }

    void
    add(const double factor, const std::vector<double> &x, std::vector<double> &y)
    {
      for (std::size_t k = 0; k < x.size(); ++k)
        y[k] += factor * x[k];
    }

    void
    scale(const double factor, std::vector<double> &x)
    {
      for (double &value : x)
        value *= factor;
    }
  } // namespace

  std::vector<std::array<double, 3>>
  triangle_nodes(const unsigned int n)
  {
    std::vector<std::array<double, 3>> nodes;
    for (unsigned int i = 0; i <= n; ++i)
      for (unsigned int j = 0; i + j <= n; ++j)
        nodes.push_back({{double(i) / n, double(j) / n, double(n - i - j) / n}});
    return nodes;
  }

  std::vector<Coordinates>
  tetrahedron_nodes(const unsigned int n)
  {
    std::vector<Coordinates> nodes;
    for (unsigned int i = 0; i <= n; ++i)
      for (const auto &t : triangle_nodes(n))
        if (t[0] * n >= i - .5)
          nodes.push_back({{double(i) / n, t[0] - double(i) / n, t[1], t[2]}});
    return nodes;
  }

  StressEquations::StressEquations(const unsigned int degree, const unsigned int n_loads)
    : part_polynomials(degree), n_loads(n_loads)
  {
    const unsigned int size = part_polynomials.size();
    for (const auto &edge : mesh::edge_vertices)
      {
        const auto         from = AlfeldSplit::corner(edge[0]);
        const Tensor<1, 3> normal
          = cross_product_3d(AlfeldSplit::corner(edge[1]) - from, AlfeldSplit::corner(4) - from);
        for (const auto &node : triangle_nodes(degree))
          {
            Coordinates b;
            b.fill(.25 * node[2]);
            b[edge[0]] += node[0];
            b[edge[1]] += node[1];
            begin();
            double sign = 1.;
            for (unsigned int part = 0; part < 4; ++part)
              if (part != edge[0] && part != edge[1])
                {
                  const Coordinates in_part = AlfeldSplit::to_part(part, b);
                  for (unsigned int i = 0; i < size; ++i)
                    add_traction(size * part + i,
                                 sign * part_polynomials.value(i, in_part) * normal);
                  sign = -1.;
                }
          }
      }
  }

  void
  StressEquations::begin()
  {
    rows.insert(rows.end(),
                3,
                Equation{std::vector<double>(n_stress(), 0.), std::vector<double>(n_loads, 0.)});
  }

  void
  StressEquations::add_traction(const unsigned int k, const Tensor<1, 3> &normal)
  {
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        rows[rows.size() - 3 + i].stress[6 * k + component[i][j]] += normal[j];
  }

  void
  StressEquations::add_divergence(const unsigned int part, const Coordinates &b)
  {
    const auto gradients = AlfeldSplit::part_gradients(part);
    for (unsigned int i = 0; i < part_polynomials.size(); ++i)
      {
        const Coordinates d = part_polynomials.derivatives(i, b);
        Tensor<1, 3>      gradient;
        for (unsigned int k = 0; k < 4; ++k)
          gradient += d[k] * gradients[k];
        add_traction(part_polynomials.size() * part + i, gradient);
      }
  }

  void
  StressEquations::add_load(const unsigned int l, const double factor)
  {
    for (unsigned int i = 0; i < 3; ++i)
      rows[rows.size() - 3 + i].load[l + i] += factor;
  }

  void
  StressEquations::make_orthogonal(const std::vector<Equation> &basis, Equation &row)
  {
    // Twice, against rounding.
    for (unsigned int pass = 0; pass < 2; ++pass)
      for (const Equation &other : basis)
        {
          const double factor = dot(other.stress, row.stress);
          add(-factor, other.stress, row.stress);
          add(-factor, other.load, row.load);
        }
  }

  void
  StressEquations::solve(std::vector<double> &particular, std::vector<double> *free_stress) const
  {
    const unsigned int n = n_stress();
    // The same equations with orthonormal rows: their loads are the coefficients of
    // the smallest solution. Rows that follow from others vanish, as the loads are in
    // equilibrium.
    std::vector<Equation> basis;
    for (Equation row : rows)
      {
        const double before = std::sqrt(dot(row.stress, row.stress));
        make_orthogonal(basis, row);
        const double norm = std::sqrt(dot(row.stress, row.stress));
        if (norm < 1e-9 * before)
          continue;
        scale(1. / norm, row.stress);
        scale(1. / norm, row.load);
        basis.push_back(row);
      }
    particular.assign(std::size_t(n_loads) * n, 0.);
    for (const Equation &row : basis)
      for (unsigned int l = 0; l < n_loads; ++l)
        for (unsigned int k = 0; k < n; ++k)
          particular[std::size_t(l) * n + k] += row.load[l] * row.stress[k];
    if (free_stress == nullptr)
      return;
    // What is left of unit vectors spans the rest.
    free_stress->clear();
    for (unsigned int k = 0; k < n && basis.size() < n; ++k)
      {
        Equation row{std::vector<double>(n, 0.), std::vector<double>(n_loads, 0.)};
        row.stress[k] = 1.;
        make_orthogonal(basis, row);
        const double norm = std::sqrt(dot(row.stress, row.stress));
        if (norm < .05)
          continue;
        scale(1. / norm, row.stress);
        free_stress->insert(free_stress->end(), row.stress.begin(), row.stress.end());
        basis.push_back(row);
      }
  }
} // namespace tetradapt::estimate
