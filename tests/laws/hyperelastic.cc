// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Laws for large deformation in one point: stress and tangent against differences of energy
// and stress at a thousand random deformations, the same when the body is turned, closed
// forms, linear elasticity near rest, and what has no response.

#include "tetradapt/core/exceptions.h"
#include "tetradapt/laws/law_catalogue.h"

#include <cmath>
#include <iostream>
#include <random>

using namespace tetradapt::laws;

namespace
{
  void
  check(const std::string &what, const double error, const double tolerance)
  {
    std::cout << "  " << what << ": ";
    if (error <= tolerance) // false for NaN
      std::cout << "right\n";
    else
      std::cout << "WRONG by " << error << '\n';
  }

  const Tensor<2, 3> I(dealii::unit_symmetric_tensor<3>());

  Tensor<2, 3>
  diagonal(const double a, const double b, const double c)
  {
    Tensor<2, 3> F;
    F[0][0] = a;
    F[1][1] = b;
    F[2][2] = c;
    return F;
  }

  /** A random rotation, by the unit quaternion of four normal numbers. */
  Tensor<2, 3>
  rotation(std::mt19937 &random)
  {
    std::normal_distribution<double> normal;
    double                           q[4], square = 0.;
    for (double &entry : q)
      {
        entry = normal(random);
        square += entry * entry;
      }
    const double s = 2. / square;
    Tensor<2, 3> R;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
        R[i][i] = 1. - s * (q[1 + j] * q[1 + j] + q[1 + k] * q[1 + k]);
        R[i][j] = s * (q[1 + i] * q[1 + j] - q[0] * q[1 + k]);
        R[j][i] = s * (q[1 + i] * q[1 + j] + q[0] * q[1 + k]);
      }
    return R;
  }

  Response
  respond(const ConstitutiveLaw &law, const Tensor<2, 3> &F)
  {
    Response response;
    if (!law.update(F - I, {}, true, response))
      std::cout << "  NO RESPONSE\n";
    return response;
  }

  double
  entry(const Tangent &tangent, const unsigned int a, const unsigned int b)
  {
    return tangent[a <= b ? tangent_index(a, b) : tangent_index(b, a)];
  }

  /** Differences of order four. */
  template <class Function>
  double
  derivative(const Function &f, const double h)
  {
    return (8. * (f(h) - f(-h)) - (f(2. * h) - f(-2. * h))) / (12. * h);
  }

  void
  check_differences(const ConstitutiveLaw &law)
  {
    std::mt19937                           random(7);
    std::uniform_real_distribution<double> stretch(std::log(0.3), std::log(3.));
    double                                 of_stress = 0., of_tangent = 0., turned = 0.;
    for (unsigned int state = 0; state < 1000; ++state)
      {
        const Tensor<2, 3> U = diagonal(std::exp(stretch(random)),
                                        std::exp(stretch(random)),
                                        std::exp(stretch(random)));
        const Tensor<2, 3> R = rotation(random), Q = rotation(random);
        const Tensor<2, 3> F        = R * U * transpose(Q);
        const Response     response = respond(law, F);
        double             scale    = 0.;
        for (const double value : response.tangent)
          scale = std::max(scale, std::abs(value));
        for (unsigned int a = 0; a < 9; ++a)
          {
            const auto moved = [&](const double h) {
              Tensor<2, 3> other = F;
              other[a / 3][a % 3] += h;
              return respond(law, other);
            };
            const double h = 1e-3 * std::min({U[0][0], U[1][1], U[2][2]});
            const double P = derivative([&](const double step) { return moved(step).energy; }, h);
            of_stress = std::max(of_stress, std::abs(P - response.stress[a / 3][a % 3]) / scale);
            for (unsigned int b = 0; b < 9; ++b)
              {
                const double A
                  = derivative([&](const double step) { return moved(step).stress[b / 3][b % 3]; },
                               h);
                of_tangent
                  = std::max(of_tangent, std::abs(A - entry(response.tangent, a, b)) / scale);
              }
          }
        const Tensor<2, 3> S     = rotation(random);
        const Response     again = respond(law, S * F);
        turned = std::max(turned, std::abs(again.energy - response.energy) / scale);
        turned = std::max(turned, (again.stress - S * response.stress).norm() / scale);
        const SymmetricTensor<2, 3> cauchy = law.cauchy_stress(F - I, response);
        turned                             = std::max(turned,
                          (Tensor<2, 3>(law.cauchy_stress(S * F - I, again))
                           - S * Tensor<2, 3>(cauchy) * transpose(S))
                              .norm()
                            / (scale + cauchy.norm()));
      }
    check("stress by differences of energy", of_stress, 1e-6);
    check("tangent by differences of stress", of_tangent, 1e-6);
    check("turned bodies", turned, 1e-12);
  }

  /** Near rest a law is linear elasticity with its moduli. */
  void
  check_rest(const ConstitutiveLaw &law, const double E, const double nu)
  {
    const Response rest = respond(law, I);
    check("stress and energy at rest", rest.stress.norm() + std::abs(rest.energy), 1e-14 * E);
    const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu)), mu = E / (2. * (1. + nu));
    const SymmetricTensor<2, 3> one = dealii::unit_symmetric_tensor<3>();
    const SymmetricTensor<4, 3> C
      = lambda * outer_product(one, one) + 2. * mu * dealii::identity_tensor<3>();
    check("tangent at rest", (law.tangent_at_rest() - C).norm(), 1e-13 * E);
    double error = 0.;
    for (unsigned int a = 0; a < 9; ++a)
      for (unsigned int b = 0; b < 9; ++b)
        error
          = std::max(error, std::abs(entry(rest.tangent, a, b) - C[a / 3][a % 3][b / 3][b % 3]));
    check("dP/dF at rest", error, 1e-13 * E);
    check("moduli",
          std::abs(law.moduli_at_rest().young_modulus - E) / E
            + std::abs(law.moduli_at_rest().poisson_ratio - nu),
          1e-13);
    check("shear modulus", std::abs(shear_modulus(law) - mu), 1e-13 * E);
  }

  /** Small strains keep their digits, and the energy is that of linear elasticity. */
  void
  check_small(const ConstitutiveLaw &law)
  {
    Tensor<2, 3> G;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        G[i][j] = std::sin(1. + 3. * i + j);
    const SymmetricTensor<2, 3> strain   = symmetrize(G);
    const SymmetricTensor<2, 3> expected = law.tangent_at_rest() * strain;
    double                      energy = 0., stress = 0.;
    for (const double size : {1e-7, 1e-10, 1e-50})
      {
        Response response;
        law.update(size * G, {}, false, response);
        stress = std::max(stress,
                          (response.stress / size - Tensor<2, 3>(expected)).norm()
                            / (expected.norm() * std::max(size, 1e-12)));
        energy = std::max(energy,
                          std::abs(response.energy / size / size / (0.5 * (strain * expected)) - 1.)
                            / std::max(size, 1e-12));
      }
    check("stress of small strains", stress, 10.);
    check("energy of small strains", energy, 10.);
  }

  void
  check_refusals(const ConstitutiveLaw &law)
  {
    Response response;
    std::cout << "  inside out: " << law.update(diagonal(1., 1., -1.) - I, {}, true, response)
              << ", flat: " << law.update(diagonal(1., 1., 0.) - I, {}, true, response)
              << ", no number: "
              << law.update(diagonal(1., 1., std::nan("")) - I, {}, true, response)
              << ", too large: " << law.update(diagonal(1e200, 1., 1.) - I, {}, true, response)
              << '\n';
  }

  void
  refuse(const std::string &what, const std::string &law, const Constants &constants)
  {
    try
      {
        make_law(law, constants);
        std::cout << what << ": ACCEPTED\n";
      }
    catch (const tetradapt::core::InputError &error)
      {
        std::cout << what << ": " << error.what() << '\n';
      }
  }
} // namespace

int
main()
{
  const double E = 3., nu = 0.25, mu = 1.2, lambda = 1.2, kappa = 2.;
  const auto   neo = make_law("neo-Hookean", {{"Young modulus", E}, {"Poisson ratio", nu}});
  const auto   split
    = make_law("split neo-Hookean", {{"Shear modulus", mu}, {"Bulk modulus", kappa}});
  const auto st_venant
    = make_law("St. Venant-Kirchhoff", {{"Young modulus", E}, {"Poisson ratio", nu}});
  for (const LawEntry &law : law_catalogue())
    {
      const auto made = make_law(law.name, {});
      std::cout << law.name << ": displacement " << made->supports(Formulation::displacement)
                << ", mixed " << made->supports(Formulation::mixed) << ", finite strain "
                << made->supports(Formulation::finite_strain) << ", constants";
      for (const Constant &constant : law.constants)
        std::cout << ' ' << constant.name << ';';
      std::cout << '\n';
    }

  const double a = 1.7, b = 0.8, J = a * b * b;
  std::cout << "neo-Hookean\n";
  check_differences(*neo);
  check_rest(*neo, E, nu);
  check_small(*neo);
  check_refusals(*neo);
  // P = mu (l - 1/l) + lambda ln J / l for each stretch l.
  {
    const auto expected
      = [&](const double l) { return mu * (l - 1. / l) + lambda * std::log(J) / l; };
    const Response r = respond(*neo, diagonal(a, b, b));
    check("stretched", (r.stress - diagonal(expected(a), expected(b), expected(b))).norm(), 1e-14);
    check("its energy",
          std::abs(r.energy - 0.5 * mu * (a * a + 2. * b * b - 3. - 2. * std::log(J))
                   - 0.5 * lambda * std::log(J) * std::log(J)),
          1e-14);
    // Simple shear by k: Cauchy's stress is mu (F F^T - I).
    Tensor<2, 3> F = I;
    F[0][1]        = 0.9;
    const Tensor<2, 3> cauchy(neo->cauchy_stress(F - I, respond(*neo, F)));
    check("sheared", (cauchy - mu * (F * transpose(F) - I)).norm(), 1e-14);
  }

  std::cout << "split neo-Hookean\n";
  check_differences(*split);
  check_rest(*split,
             9. * kappa * mu / (3. * kappa + mu),
             (3. * kappa - 2. * mu) / (6. * kappa + 2. * mu));
  check_small(*split);
  check_refusals(*split);
  {
    // Blown up, there is pressure only: Cauchy's is kappa (J - 1).
    const double       l = 1.3, volume = l * l * l;
    const Tensor<2, 3> F = l * I;
    check("blown up",
          (Tensor<2, 3>(split->cauchy_stress(F - I, respond(*split, F)))
           - kappa * (volume - 1.) * I)
            .norm(),
          1e-13);
    // With J = 1 the deviator is that of mu F F^T.
    const Tensor<2, 3> G = diagonal(2., std::sqrt(0.5), std::sqrt(0.5));
    const Tensor<2, 3> stress(split->cauchy_stress(G - I, respond(*split, G)));
    const Tensor<2, 3> B = mu * G * transpose(G);
    check("pulled without change of volume", (stress - (B - trace(B) / 3. * I)).norm(), 1e-13);
  }

  std::cout << "St. Venant-Kirchhoff\n";
  check_differences(*st_venant);
  check_rest(*st_venant, E, nu);
  check_small(*st_venant);
  check_refusals(*st_venant);
  {
    // Free to contract a bar of it has P = E/2 l (l^2 - 1), lateral strain -nu times the axial.
    const double   l = 0.9, strain = 0.5 * (l * l - 1.), side = std::sqrt(1. - 2. * nu * strain);
    const Response r = respond(*st_venant, diagonal(l, side, side));
    check("bar", (r.stress - diagonal(E * l * strain, 0., 0.)).norm(), 1e-14);
  }

  // A linear law through the same interface.
  std::cout << "linear elastic\n";
  const auto linear = make_law("linear elastic", {{"Young modulus", E}, {"Poisson ratio", nu}});
  check_rest(*linear, E, nu);
  check_small(*linear);

  refuse("nu = 0.5", "neo-Hookean", {{"Poisson ratio", 0.5}});
  refuse("no bulk modulus", "split neo-Hookean", {{"Bulk modulus", 0.}});
  refuse("E < 0", "St. Venant-Kirchhoff", {{"Young modulus", -1.}});
  refuse("no such law", "Mooney", {});
}
