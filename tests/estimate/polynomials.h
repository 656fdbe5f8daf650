// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_tests_estimate_polynomials_h
#define tetradapt_tests_estimate_polynomials_h

#include "tetradapt/estimate/estimator.h"
#include "tetradapt/mechanics/material_map.h"

#include "../solve/solving.h"

/** Problems on the unit cube whose displacement is a polynomial of the degree after the
 * solution's, so that the space of that degree holds it. E = 1, nu = 1/4: lambda = mu = 0.4.
 * Displacements are prescribed on five faces, tractions on z = 1. */
namespace polynomials
{
  using namespace bodies;

  inline scene::Scene
  make_scene(const unsigned int degree)
  {
    scene::Scene scene;
    scene.degree    = degree;
    scene.materials = {material("all", 1., 0.25)};
    const Texts u
      = degree == 1 ? Texts{{"y^2 + x*z", "x^2 - z^2", "x*y"}} : Texts{{"y^3", "x*z^2", "x^2*y"}};
    const Texts f
      = degree == 1 ? Texts{{"-0.8", "0", "-0.8"}} : Texts{{"-2.4*y", "-0.8*x", "-0.8*y"}};
    const Texts t                     = degree == 1 ? Texts{{"0.4*(x + y)", "0.4*(x - 2)", "0.4"}}
                                                    : Texts{{"0.8*x*y", "0.4*(2*x + x^2)", "0"}};
    scene.supports                    = {support(
      "five", "x < 1e-9 || x > 1 - 1e-9 || y < 1e-9 || y > 1 - 1e-9 || z < 1e-9", "xyz", u)};
    scene.loads                       = {load("inside", scene::LoadType::body_force, "", f),
                                         load("top", scene::LoadType::traction, "z > 1 - 1e-9", t)};
    scene.exact_solution.displacement = u;
    scene.exact_solution.gradient
      = degree == 1
          ? std::array<std::string, 9>{{"z", "2*y", "x", "2*x", "0", "-2*z", "y", "x", "0"}}
          : std::array<std::string, 9>{
            {"0", "3*y^2", "0", "z^2", "0", "2*x*z", "2*x*y", "x^2", "0"}};
    scene.solver.tolerance = 1e-11;
    return scene;
  }

  /** Free thermal expansion for the temperature x, without stress: u = alpha (x^2 - y^2 - z^2,
   * 2 x y, 2 x z) / 2, of degree 2; alpha = 0.2. */
  inline scene::Scene
  make_heated_scene()
  {
    scene::Scene scene;
    scene.materials                      = {material("all", 1., 0.25)};
    scene.materials[0].thermal_expansion = 0.2;
    scene.supports = {support("end", "x < 1e-9", "xyz", {{"-0.1*(y^2 + z^2)", "0", "0"}})};
    scene.loads    = {load("heat", scene::LoadType::temperature, "", {{"x", "0", "0"}})};
    scene.exact_solution.displacement = {{"0.1*(x^2 - y^2 - z^2)", "0.2*x*y", "0.2*x*z"}};
    scene.solver.tolerance            = 1e-11;
    return scene;
  }

  /** A scene solved on the cube, with what estimators ask for. */
  struct Solved
  {
    Solved(const scene::Scene &scene, const unsigned int n)
      : scene(scene), body(box(Point<3>(1, 1, 1), {{n, n, n}}))
    {
      select(*body, scene);
      materials         = std::make_unique<mechanics::MaterialMap>(scene, *body);
      const auto system = std::make_shared<solve::StaticSystem>(
        scene, *materials, body, scene.degree, MPI_COMM_WORLD, core::Log());
      solution        = system->solve(nullptr, {});
      solution.system = system;
      comparison      = std::make_unique<estimate::Comparison>(
        solution.displacement, *materials, scene.exact_solution, nullptr, MPI_COMM_WORLD);
    }

    estimate::Estimate
    operator()(const estimate::Estimator &estimator) const
    {
      return estimator.estimate({*comparison, scene, solution, levels});
    }

    const scene::Scene                     &scene;
    std::shared_ptr<mesh::TetMesh>          body;
    std::unique_ptr<mechanics::MaterialMap> materials;
    solve::StaticSolution                   solution;
    std::unique_ptr<estimate::Comparison>   comparison;
    std::vector<estimate::EnergyLevel>      levels;
  };
} // namespace polynomials

#endif
