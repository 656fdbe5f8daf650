// SPDX-License-Identifier: AGPL-3.0-or-later
#include "element.h"

#include "equations.h"

#include <algorithm>
#include <stdexcept>

namespace tetradapt::estimate
{
  using dealii::Tensor;

  namespace
  {
    /** Means over a triangle of the products of l_0, l_1, l_2, 4 l_0 l_1, 4 l_1 l_2,
     * 4 l_2 l_0: int l^a = 2 |F| a! / (|a|+2)!. */
    double
    face_product(const unsigned int s, const unsigned int r)
    {
      if (s < 3 && r < 3)
        return s == r ? 1. / 6. : 1. / 12.;
      if (s >= 3 && r >= 3)
        return s == r ? 8. / 45. : 4. / 45.;
      const unsigned int vertex = std::min(s, r), edge = std::max(s, r) - 3;
      return (edge + 2) % 3 == vertex ? 1. / 15. : 2. / 15.;
    }

    /** The same with the first function made orthogonal to l_0, l_1, l_2, if it is not
     * one of them. */
    double
    moment_of(const unsigned int s, const unsigned int r)
    {
      if (s < 3)
        return face_product(s, r);
      return face_product(s, r) - .6 * (face_product(s - 3, r) + face_product((s - 2) % 3, r))
             + .2 * face_product((s - 1) % 3, r);
    }

    /** Area times outer normal of a face of the unit tetrahedron. */
    Tensor<1, 3>
    face_normal(const unsigned int face)
    {
      const auto corners = AlfeldSplit::part_corners(face);
      const auto from    = AlfeldSplit::corner(corners[0]);
      return .5
             * cross_product_3d(AlfeldSplit::corner(corners[1]) - from,
                                AlfeldSplit::corner(corners[2]) - from);
    }

    /** The moments of the traction on the faces. */
    void
    add_moments(StressEquations &equations)
    {
      const PartPolynomials &polynomials = equations.polynomials();
      const double           nodes[6][3]
        = {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}, {.5, .5, 0.}, {0., .5, .5}, {.5, 0., .5}};
      for (unsigned int face = 0; face < 4; ++face)
        for (unsigned int s = 0; s < 6; ++s)
          {
            equations.begin();
            equations.add_load(18 * face + 3 * s, 1.);
            for (unsigned int n = 0; n < 10; ++n)
              {
                // Coefficients of l_0, .., 4 l_0 l_1, .. from values at the nodes.
                double values[6], sum = 0.;
                for (unsigned int r = 0; r < 6; ++r)
                  values[r] = polynomials.value(n, {{nodes[r][0], nodes[r][1], nodes[r][2], 0.}});
                for (unsigned int r = 0; r < 6; ++r)
                  sum += moment_of(s, r)
                         * (r < 3 ? values[r]
                                  : values[r] - .5 * (values[r - 3] + values[(r - 2) % 3]));
                equations.add_traction(10 * face + n, sum * face_normal(face));
              }
          }
    }
  } // namespace

  EquilibratedElement::EquilibratedElement()
  {
    StressEquations equations(2, n_loads);
    add_moments(equations);
    for (unsigned int part = 0; part < 4; ++part)
      for (const Coordinates &node : tetrahedron_nodes(1))
        {
          const Coordinates b = AlfeldSplit::from_part(part, node);
          equations.begin();
          equations.add_divergence(part, node);
          for (unsigned int k = 0; k < 4; ++k)
            equations.add_load(n_moments + 3 * k, -b[k]);
        }
    equations.solve(particular, &free_stress);
    if (free_stress.size() != n_free * n_stress)
      throw std::logic_error("The space of equilibrated stresses has a wrong dimension.");
    multiply_stresses();
  }

  const EquilibratedElement &
  EquilibratedElement::instance()
  {
    static const EquilibratedElement element;
    return element;
  }

  const std::vector<double> &
  EquilibratedElement::quadratic_forces()
  {
    static const std::vector<double> table = [] {
      StressEquations        equations(3, n_quadratic);
      const PartPolynomials &polynomials = equations.polynomials();
      for (unsigned int face = 0; face < 4; ++face)
        for (const auto &node : triangle_nodes(3))
          {
            equations.begin();
            for (unsigned int n = 0; n < polynomials.size(); ++n)
              equations.add_traction(polynomials.size() * face + n,
                                     polynomials.value(n, {{node[0], node[1], node[2], 0.}})
                                       * face_normal(face));
          }
      for (unsigned int part = 0; part < 4; ++part)
        for (const Coordinates &node : tetrahedron_nodes(2))
          {
            const Coordinates b = AlfeldSplit::from_part(part, node);
            equations.begin();
            equations.add_divergence(part, node);
            for (unsigned int e = 0; e < 6; ++e)
              equations.add_load(3 * e, -orthogonal_bubble(e, b));
          }
      std::vector<double> particular;
      equations.solve(particular, nullptr);
      return particular;
    }();
    return table;
  }

  double
  EquilibratedElement::orthogonal_bubble(const unsigned int e, const std::array<double, 4> &b)
  {
    // With int b_i = V/4, int b_i b_k = V/20 and int b_i b_j b_k = V/120 (twice that
    // for i = j) the projection of 4 b_i b_k is 2/3 (b_i + b_k) - 2/15.
    const auto &v = mesh::edge_vertices[e];
    return 4. * b[v[0]] * b[v[1]] - (2. / 3.) * (b[v[0]] + b[v[1]]) + 2. / 15.;
  }

  std::array<double, 6>
  EquilibratedElement::value(const double                *stress,
                             const unsigned int           part,
                             const std::array<double, 4> &b)
  {
    static const PartPolynomials polynomials(2);
    const Coordinates            in_part = AlfeldSplit::to_part(part, b);
    std::array<double, 6>        result{};
    for (unsigned int n = 0; n < 10; ++n)
      {
        const double p = polynomials.value(n, in_part);
        for (unsigned int c = 0; c < 6; ++c)
          result[c] += p * stress[6 * (10 * part + n) + c];
      }
    return result;
  }

  void
  EquilibratedElement::multiply_stresses()
  {
    // Nine pairs at a time: 21 times nine numbers.
    std::vector<std::array<const double *, 2>> pairs;
    const auto add = [&](std::vector<double> &table, const double *A, const double *B) {
      pairs.push_back({{A, B}});
      if (pairs.size() < 9)
        return;
      for (unsigned int p = 0; p < 6; ++p)
        for (unsigned int q = p; q < 6; ++q)
          for (const auto &pair : pairs)
            {
              double sum = 0.;
              for (unsigned int k = 0; k < n_stress; k += 6)
                sum += pair[0][k + p] * pair[1][k + q]
                       + (p == q ? 0. : pair[0][k + q] * pair[1][k + p]);
              table.push_back(sum);
            }
      pairs.clear();
    };
    for (unsigned int a = 0; a < n_free; ++a)
      for (unsigned int b = 0; b <= a; ++b)
        add(free_products, &free_stress[a * n_stress], &free_stress[b * n_stress]);
    for (unsigned int l = 0; l < n_moments; ++l)
      for (unsigned int a = 0; a < n_free; ++a)
        add(mixed_products, &particular[l * n_stress], &free_stress[a * n_stress]);
    for (unsigned int n = 0; n < n_moments; n += 3)
      for (unsigned int m = 0; m <= n; m += 3)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            add(moment_products, &particular[(n + i) * n_stress], &particular[(m + j) * n_stress]);
  }
} // namespace tetradapt::estimate
