// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/tet_quadrature.h"

#include <cmath>
#include <stdexcept>

namespace tetradapt::compare
{
  namespace
  {
    void
    add(TetQuadrature &rule, const mesh::Barycentric &point, const double weight)
    {
      rule.points.push_back(point);
      rule.weights.push_back(weight);
    }

    /** (1 - 3a, a, a, a) and its permutations: 4 points. */
    void
    add_4(TetQuadrature &rule, const double a, const double weight)
    {
      for (unsigned int i = 0; i < 4; ++i)
        {
          mesh::Barycentric b{{a, a, a, a}};
          b[i] = 1. - 3. * a;
          add(rule, b, weight);
        }
    }

    /** (a, a, c, c) with c = 1/2 - a and its permutations: 6 points. */
    void
    add_6(TetQuadrature &rule, const double a, const double weight)
    {
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = i + 1; j < 4; ++j)
          {
            mesh::Barycentric b{{.5 - a, .5 - a, .5 - a, .5 - a}};
            b[i] = b[j] = a;
            add(rule, b, weight);
          }
    }

    /** (c, d, a, a) with d = 1 - 2a - c and its permutations: 12 points. */
    void
    add_12(TetQuadrature &rule, const double a, const double c, const double weight)
    {
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          if (i != j)
            {
              mesh::Barycentric b{{a, a, a, a}};
              b[i] = c;
              b[j] = 1. - 2. * a - c;
              add(rule, b, weight);
            }
    }

    TetQuadrature
    make_1()
    {
      TetQuadrature rule;
      add(rule, {{.25, .25, .25, .25}}, 1.);
      return rule;
    }

    TetQuadrature
    make_4()
    {
      TetQuadrature rule;
      add_4(rule, (5. - std::sqrt(5.)) / 20., .25);
      return rule;
    }

    TetQuadrature
    make_14()
    {
      TetQuadrature rule;
      add_4(rule, 0.31088591926330060980, 6. * 0.018781320953002641800);
      add_4(rule, 0.092735250310891226402, 6. * 0.012248840519393658257);
      add_6(rule, 0.045503704125649649492, 6. * 0.0070910034628469110730);
      return rule;
    }

    TetQuadrature
    make_24()
    {
      TetQuadrature rule;
      add_4(rule, 0.214602871259151684, 6. * 0.00665379170969464506);
      add_4(rule, 0.0406739585346113397, 6. * 0.00167953517588677620);
      add_4(rule, 0.322337890142275646, 6. * 0.00922619692394239843);
      add_12(rule, 0.0636610018750175299, 0.269672331458315867, 6. * 0.00803571428571428248);
      return rule;
    }
  } // namespace

  const TetQuadrature &
  tet_quadrature(const unsigned int degree)
  {
    static const TetQuadrature points_1 = make_1(), points_4 = make_4(), points_14 = make_14(),
                               points_24 = make_24();
    if (degree > 6)
      throw std::logic_error("There is no quadrature on tetrahedra of such a high degree.");
    return degree < 2 ? points_1 : degree < 3 ? points_4 : degree < 6 ? points_14 : points_24;
  }
} // namespace tetradapt::compare
