// SPDX-License-Identifier: AGPL-3.0-or-later
#include "polynomials.h"

#include <cmath>

namespace tetradapt::estimate
{
  using dealii::Point;
  using dealii::Tensor;

  Point<3>
  AlfeldSplit::corner(const unsigned int number)
  {
    Point<3> p;
    if (number == 4)
      return Point<3>(.25, .25, .25);
    if (number > 0)
      p[number - 1] = 1.;
    return p;
  }

  std::array<Tensor<1, 3>, 4>
  AlfeldSplit::part_gradients(const unsigned int part)
  {
    const auto                  corners = part_corners(part);
    std::array<Tensor<1, 3>, 4> gradients;
    for (unsigned int i = 0; i < 4; ++i)
      {
        const Point<3>     a = corner(corners[(i + 1) % 4]);
        const Tensor<1, 3> normal
          = cross_product_3d(corner(corners[(i + 2) % 4]) - a, corner(corners[(i + 3) % 4]) - a);
        gradients[i] = normal / (normal * (corner(corners[i]) - a));
      }
    return gradients;
  }

  Coordinates
  AlfeldSplit::to_part(const unsigned int part, const Coordinates &b)
  {
    // The coordinate of the corner opposite to the part's face is a quarter of the
    // centroid's.
    const auto &face = mesh::face_vertices[part];
    return {{b[face[0]] - b[part], b[face[1]] - b[part], b[face[2]] - b[part], 4. * b[part]}};
  }

  Coordinates
  AlfeldSplit::from_part(const unsigned int part, const Coordinates &b)
  {
    Coordinates result;
    result.fill(.25 * b[3]);
    for (unsigned int i = 0; i < 3; ++i)
      result[mesh::face_vertices[part][i]] += b[i];
    return result;
  }

  namespace
  {
    double
    power(const double x, const unsigned int n)
    {
      double result = 1.;
      for (unsigned int i = 0; i < n; ++i)
        result *= x;
      return result;
    }

    /** Integral over a part: int b^a = 6 V a! / (|a|+3)!. */
    double
    integral(const std::array<unsigned int, 4> &a, const std::array<unsigned int, 4> &b)
    {
      double       result = 6. / 24.;
      unsigned int sum    = 3;
      for (unsigned int i = 0; i < 4; ++i)
        {
          result *= std::tgamma(a[i] + b[i] + 1.);
          sum += a[i] + b[i];
        }
      return result / std::tgamma(sum + 1.);
    }
  } // namespace

  PartPolynomials::PartPolynomials(const unsigned int degree)
  {
    const auto add = [&](std::initializer_list<unsigned int> factors) {
      powers.push_back({{0, 0, 0, 0}});
      for (const unsigned int f : factors)
        ++powers.back()[f];
    };
    for (unsigned int i = 0; i < 4; ++i)
      add({i});
    for (const auto &edge : mesh::edge_vertices)
      add({edge[0], edge[1]});
    if (degree == 3)
      {
        for (const auto &edge : mesh::edge_vertices)
          add({edge[0], edge[0], edge[1]});
        for (const auto &face : mesh::face_vertices)
          add({face[0], face[1], face[2]});
      }
    // Gram and Schmidt, twice against rounding.
    const auto product = [&](const std::vector<double> &a, const std::vector<double> &b) {
      double sum = 0.;
      for (unsigned int i = 0; i < a.size(); ++i)
        for (unsigned int j = 0; j < b.size(); ++j)
          sum += a[i] * b[j] * integral(powers[i], powers[j]);
      return sum;
    };
    for (unsigned int i = 0; i < powers.size(); ++i)
      {
        std::vector<double> row(i + 1, 0.);
        row[i] = 1.;
        for (unsigned int pass = 0; pass < 2; ++pass)
          for (const auto &other : rows)
            {
              const double factor = product(row, other);
              for (unsigned int j = 0; j < other.size(); ++j)
                row[j] -= factor * other[j];
            }
        const double norm = std::sqrt(product(row, row));
        for (double &value : row)
          value /= norm;
        rows.push_back(row);
      }
  }

  double
  PartPolynomials::value(const unsigned int i, const Coordinates &b) const
  {
    double sum = 0.;
    for (unsigned int j = 0; j <= i; ++j)
      {
        double term = rows[i][j];
        for (unsigned int d = 0; d < 4; ++d)
          term *= power(b[d], powers[j][d]);
        sum += term;
      }
    return sum;
  }

  Coordinates
  PartPolynomials::derivatives(const unsigned int i, const Coordinates &b) const
  {
    Coordinates sum{};
    for (unsigned int j = 0; j <= i; ++j)
      for (unsigned int e = 0; e < 4; ++e)
        if (powers[j][e] > 0)
          {
            double term = rows[i][j] * powers[j][e];
            for (unsigned int d = 0; d < 4; ++d)
              term *= power(b[d], powers[j][d] - (d == e ? 1 : 0));
            sum[e] += term;
          }
    return sum;
  }
} // namespace tetradapt::estimate
