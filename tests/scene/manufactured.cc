// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The body force and the traction of the manufactured scenes, derived by hand,
// against differences of the displacement: div sigma + f = 0 and sigma n = t.

#include "tetradapt/core/expression.h"
#include "tetradapt/scene/scene_reader.h"

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <iostream>

using namespace tetradapt;
using dealii::Point;
using dealii::Tensor;

namespace
{
  const double step = 1e-3;

  /** Derivatives by differences of order four. */
  template <class Function>
  auto
  derivative(const Function &f, const Point<3> &p, const unsigned int d)
  {
    Point<3> a = p, b = p, c = p, e = p;
    a[d] += step;
    b[d] -= step;
    c[d] += 2. * step;
    e[d] -= 2. * step;
    return (8. * (f(a) - f(b)) - (f(c) - f(e))) / (12. * step);
  }

  void
  check(const std::string &file)
  {
    const scene::Scene           scene = scene::read_scene(file);
    const core::VectorExpression u(scene.exact_solution.displacement, "u"),
      f(scene.loads[0].value, "f"), t(scene.loads[1].value, "t"),
      support(scene.supports[0].displacement, "support");
    const double E      = scene.materials[0].constants.at("Young modulus"),
                 nu     = scene.materials[0].constants.at("Poisson ratio");
    const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu)), mu = E / (2. * (1. + nu));

    const auto gradient = [&](const Point<3> &p) {
      Tensor<2, 3> G;
      for (unsigned int j = 0; j < 3; ++j)
        {
          const Tensor<1, 3> column = derivative(u, p, j);
          for (unsigned int i = 0; i < 3; ++i)
            G[i][j] = column[i];
        }
      return G;
    };
    const auto stress = [&](const Point<3> &p) {
      const Tensor<2, 3> G     = gradient(p);
      Tensor<2, 3>       sigma = mu * (G + transpose(G));
      for (unsigned int i = 0; i < 3; ++i)
        sigma[i][i] += lambda * trace(G);
      return sigma;
    };

    double imbalance = 0., wrong_traction = 0., wrong_gradient = 0., wrong_support = 0.;
    for (const Point<3> &p : {Point<3>(.31, .62, .45), Point<3>(.7, .2, .9), Point<3>(.1, .8, .3)})
      {
        Tensor<1, 3> residual = f(p);
        for (unsigned int j = 0; j < 3; ++j)
          {
            const Tensor<2, 3> change = derivative(stress, p, j);
            for (unsigned int i = 0; i < 3; ++i)
              residual[i] += change[i][j];
          }
        imbalance = std::max(imbalance, residual.norm() / f(p).norm());

        const Point<3> top(p[0], p[1], 1.);
        Tensor<1, 3>   traction;
        for (unsigned int i = 0; i < 3; ++i)
          traction[i] = stress(top)[i][2];
        wrong_traction = std::max(wrong_traction, (traction - t(top)).norm());

        const Tensor<2, 3> G = gradient(p);
        for (unsigned int i = 0; i < 9; ++i)
          wrong_gradient
            = std::max(wrong_gradient,
                       std::abs(core::Expression(scene.exact_solution.gradient[i], "gradient")(p)
                                - G[i / 3][i % 3]));
        wrong_support = std::max(wrong_support, (support(p) - u(p)).norm());
      }
    std::cout << "lambda " << lambda << ", mu " << mu << '\n'
              << "balance of forces: " << (imbalance < 1e-8 ? "ok" : "FAILED") << '\n'
              << "traction: " << (wrong_traction < 1e-8 ? "ok" : "FAILED") << '\n'
              << "gradient: " << (wrong_gradient < 1e-8 ? "ok" : "FAILED") << '\n'
              << "support: " << (wrong_support == 0. ? "ok" : "FAILED") << '\n';
    if (imbalance >= 1e-8 || wrong_traction >= 1e-8 || wrong_gradient >= 1e-8)
      std::cout << imbalance << ' ' << wrong_traction << ' ' << wrong_gradient << '\n';
  }
} // namespace

int
main()
{
  check(SOURCE_DIR "/../../prm/verification/manufactured_p1.prm");
  check(SOURCE_DIR "/../../prm/verification/manufactured_p2.prm");
}
