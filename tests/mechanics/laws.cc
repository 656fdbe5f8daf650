// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Linear elasticity in one point, against the textbook's formulas in E and nu, and
// who gets which material and temperature.

#include "tetradapt/laws/linear_elastic.h"
#include "tetradapt/mechanics/material_map.h"

#include "bodies.h"

using namespace bodies;
using dealii::SymmetricTensor;

namespace
{
  double
  distance(const SymmetricTensor<2, 3> &a, const SymmetricTensor<2, 3> &b)
  {
    return (a - b).norm();
  }

  void
  check_law(const double E, const double nu)
  {
    std::cout << "E = " << E << ", nu = " << nu << '\n';
    const laws::LinearElastic law(E, nu);

    // Pulled along x to a stress of 2, free to contract.
    Tensor<2, 3> G;
    G[0][0] = 2. / E;
    G[1][1] = G[2][2] = -nu * 2. / E;
    SymmetricTensor<2, 3> uniaxial;
    uniaxial[0][0] = 2.;
    check("  uniaxial stress", distance(law.stress(G), uniaxial), 0., 2., 1e-14 / (1. - 2. * nu));

    // Simple shear with an angle of 0.01: mu = E / (2 (1 + nu)).
    G       = 0.;
    G[0][2] = 0.01;
    SymmetricTensor<2, 3> shear;
    shear[0][2] = 0.01 * E / (2. * (1. + nu));
    check("  shear stress", distance(law.stress(G), shear), 0., shear.norm(), 1e-14);

    // Blown up: a pressure of 3 K times the strain, K = E / (3 (1 - 2 nu)).
    G = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      G[d][d] = 0.01;
    const auto hydrostatic = 0.01 * E / (1. - 2. * nu) * dealii::unit_symmetric_tensor<3>();
    check(
      "  hydrostatic stress", distance(law.stress(G), hydrostatic), 0., hydrostatic.norm(), 1e-14);

    // Turned: no stress.
    G       = 0.;
    G[0][1] = 0.3;
    G[1][0] = -0.3;
    check("  stress of a rotation", law.stress(G).norm(), 0., E, 1e-15);

    // A state without symmetries.
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        G[i][j] = 0.01 * std::sin(1. + 3. * i + j);
    const auto strain = symmetrize(G), stress = law.stress(G);
    const auto C         = law.tangent_at_rest();
    double     asymmetry = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int l = 0; l < 3; ++l)
            asymmetry = std::max(asymmetry, std::abs(C[i][j][k][l] - C[k][l][i][j]));
    check("  asymmetry of the tangent", asymmetry, 0., C.norm(), 1e-15);
    check("  tangent times strain", distance(C * strain, stress), 0., stress.norm(), 1e-14);
    const double density = strain * stress;
    check("  energy density", law.energy_density(strain), density, density, 1e-14);
    check("  complementary density",
          law.complementary_density(stress),
          density,
          density,
          1e-13 / (1. - 2. * nu));
  }

  void
  check_maps(const mesh::TetMesh &body)
  {
    scene::Scene scene;
    scene.materials                      = {material("soft", 10., 0.2), material("hard", 1e4, 0.3)};
    scene.materials[0].thermal_expansion = 1e-3;
    scene.materials[1].thermal_expansion = 2e-3;
    scene.materials[1].region_groups     = {"bone"};
    scene.loads = {load("warm", scene::LoadType::temperature, "", {{"10 + x", "", ""}}),
                   load("fever", scene::LoadType::temperature, "", {{"2", "", ""}})};
    scene.loads[1].selector.ids = {1};
    const mechanics::MaterialMap map(scene, body);
    std::cout << "materials of regions 0 and 1: " << map.parameters(0).name << ", "
              << map.parameters(1).name << '\n';
    check("thermal strain", map.has_thermal_strain());
    const Point<3> p(0.5, 7., 9.);
    const auto     I = dealii::unit_symmetric_tensor<3>();
    check("  of region 0", distance(map.thermal_strain(0, p), 10.5e-3 * I), 0., 1e-3, 1e-12);
    check("  of region 1", distance(map.thermal_strain(1, p), 25e-3 * I), 0., 1e-3, 1e-12);
    scene.loads.clear();
    check("none without temperatures", !mechanics::MaterialMap(scene, body).has_thermal_strain());
  }

  void
  refusals(const mesh::TetMesh &body)
  {
    const auto with = [&](const std::vector<scene::MaterialParameters> &materials) {
      scene::Scene scene;
      scene.materials = materials;
      mechanics::MaterialMap(scene, body);
    };
    const auto of_region = [](scene::MaterialParameters m, const int region) {
      m.regions = {region};
      return m;
    };
    const auto a = material("a", 1., 0.), b = material("b", 2., 0.);
    print_refusal("nu = 0.6", [&] { with({material("a", 1., 0.6)}); });
    print_refusal("E = 0", [&] { with({material("a", 0., 0.3)}); });
    print_refusal("E is no number", [&] { with({material("a", std::nan(""), 0.3)}); });
    print_refusal("unknown law", [&] {
      auto m = a;
      m.law  = "plastic";
      with({m});
    });
    print_refusal("law of large deformation", [&] {
      auto m = a;
      m.law  = "neo-Hookean";
      with({m});
    });
    print_refusal("linear law wanted of another", [&] {
      scene::Scene scene;
      scene.formulation      = scene::Formulation::finite_strain;
      scene.materials        = {a};
      scene.materials[0].law = "neo-Hookean";
      mechanics::MaterialMap(scene, body).linear_law(0);
    });
    print_refusal("two for the rest", [&] { with({a, b}); });
    print_refusal("two for one region", [&] { with({of_region(a, 0), of_region(b, 0)}); });
    print_refusal("region without", [&] { with({of_region(a, 0)}); });
    print_refusal("no such region", [&] { with({a, of_region(b, 7)}); });
    print_refusal("no such group", [&] {
      auto m          = b;
      m.region_groups = {"bones"};
      with({a, m});
    });
    print_refusal("temperature elsewhere", [&] {
      scene::Scene scene;
      scene.materials = {a};
      scene.loads     = {load("warm", scene::LoadType::temperature, "", {{"1", "", ""}})};
      scene.loads[0].selector.groups = {"fat"};
      mechanics::MaterialMap(scene, body);
    });
    const mesh::TetMesh plain = *box(Point<3>(1, 1, 1), {{1, 1, 1}});
    scene::Scene        scene;
    scene.materials = {a};
    const mechanics::MaterialMap map(scene, plain);
    print_refusal("asked for another mesh's region", [&] { map.linear_law(1); });
  }
} // namespace

int
main()
{
  check_law(1000., 0.3);
  check_law(1., 0.);
  check_law(2e11, 0.4999);
  check_law(3., -0.9);
  auto body          = box(Point<3>(2, 1, 1), {{2, 1, 1}}, 0.2, 1.);
  body->region_names = {{1, "bone"}};
  check_maps(*body);
  refusals(*body);
}
