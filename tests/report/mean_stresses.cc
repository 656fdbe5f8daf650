// SPDX-License-Identifier: AGPL-3.0-or-later
// Mean stresses of cells against values calculated by hand.

#include "tetradapt/report/mean_stresses.h"

#include <cmath>
#include <iostream>

using namespace tetradapt;
using dealii::Point;
using dealii::Tensor;

/** Two tetrahedra that share a face, each a region. */
std::shared_ptr<mesh::TetMesh>
make_mesh()
{
  auto m     = std::make_shared<mesh::TetMesh>();
  m->points  = {{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}, {1.1, 0.9, 1.2}};
  m->cells   = {{{0, 1, 2, 3}}, {{1, 2, 3, 4}}};
  m->regions = {3, 8};
  return m;
}

scene::Scene
make_scene()
{
  scene::Scene scene;
  scene.materials.resize(2);
  scene.materials[0].name                       = "soft";
  scene.materials[0].regions                    = {3};
  scene.materials[0].constants["Young modulus"] = 2.;
  scene.materials[0].constants["Poisson ratio"] = 0.25; // lambda = mu = 0.8
  scene.materials[0].thermal_expansion          = 0.1;
  scene.materials[1].name                       = "stiff";
  scene.materials[1].regions                    = {8};
  scene.materials[1].constants["Young modulus"] = 30.;
  scene.materials[1].constants["Poisson ratio"] = 0.; // lambda = 0, mu = 15
  return scene;
}

void
print(const std::string &what, const report::MeanStresses &result)
{
  std::cout << what << std::endl;
  for (unsigned int cell = 0; cell < result.von_mises.size(); ++cell)
    {
      for (unsigned int c = 0; c < 6; ++c)
        std::cout << (c == 0 ? "  " : " ") << report::stress_component_names[c] << ' '
                  << (std::abs(result.stress[6 * cell + c]) < 1e-14 ? 0.
                                                                    : result.stress[6 * cell + c]);
      std::cout << " von Mises " << (result.von_mises[cell] < 1e-14 ? 0. : result.von_mises[cell])
                << std::endl;
    }
}

template <typename Function>
mesh::NodalField
interpolate(const std::shared_ptr<mesh::TetMesh> &m, const unsigned int degree, const Function &u)
{
  mesh::NodalField field(m, degree);
  for (unsigned int n = 0; n < field.n_nodes(); ++n)
    field.values[n] = u(field.node_position(n));
  return field;
}

int
main()
{
  std::cout.precision(10);
  const auto                   m     = make_mesh();
  scene::Scene                 scene = make_scene();
  const mechanics::MaterialMap materials(scene, *m);

  // Strain xx 0.1, yy -0.2, zz 0.3, xy 0.05, yz 0.1, xz -0.15 everywhere, and a
  // rotation that makes no stress. Region 3: 0.8 * 0.2 + 1.6 eps; region 8: 30 eps.
  const auto linear = [](const Point<3> &p) {
    return Tensor<1, 3>(
      {0.1 * p[0] + 0.15 * p[1] - 0.3 * p[2], -0.05 * p[0] - 0.2 * p[1] + 0.2 * p[2], 0.3 * p[2]});
  };
  print("linear, degree 1", report::mean_stresses(interpolate(m, 1, linear), materials));
  print("linear, degree 2", report::mean_stresses(interpolate(m, 2, linear), materials));

  // u_x = x^2: strain xx = 2x with the mean 2 x_c, x_c = 1/4 and 0.525. Region 3:
  // xx 2.4 * 0.5, yy and zz 0.8 * 0.5; region 8: xx 30 * 1.05.
  const auto quadratic = [](const Point<3> &p) { return Tensor<1, 3>({p[0] * p[0], 0., 0.}); };
  print("quadratic, degree 2", report::mean_stresses(interpolate(m, 2, quadratic), materials));

  // Nothing moves while region 3 warms up by x^2, whose mean is 1/10 on the unit
  // tetrahedron: -(3 lambda + 2 mu) alpha / 10 = -0.04 in xx, yy, zz. Region 8 does
  // not expand.
  scene.loads.resize(1);
  scene.loads[0].name  = "warmth";
  scene.loads[0].type  = scene::LoadType::temperature;
  scene.loads[0].value = {{"x^2", "0", "0"}};
  const mechanics::MaterialMap warm(scene, *m);
  print("thermal", report::mean_stresses(mesh::NodalField(m, 1), warm));

  // Free expansion: u = alpha T x with T = 2 leaves region 3 without stress and
  // gives region 8 30 * 0.2 in xx, yy, zz.
  scene.loads[0].value = {{"2", "0", "0"}};
  const mechanics::MaterialMap even(scene, *m);
  print("free expansion",
        report::mean_stresses(
          interpolate(m, 2, [](const Point<3> &p) { return Tensor<1, 3>(0.2 * p); }), even));
}
