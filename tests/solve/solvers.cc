// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The iterative solver finds what the direct one finds, in few iterations, and says
// so when it does not.

#include "solving.h"

#include <deal.II/base/mpi.h>

using namespace bodies;
using scene::LoadType;

namespace
{
  double
  distance(const mesh::NodalField &a, const mesh::NodalField &b)
  {
    double largest = 0., scale = 0.;
    for (unsigned int node = 0; node < a.n_nodes(); ++node)
      {
        largest = std::max(largest, (a.values[node] - b.values[node]).norm());
        scale   = std::max(scale, a.values[node].norm());
      }
    return largest / scale;
  }

  scene::Scene
  cantilever(const double nu, const double contrast)
  {
    scene::Scene scene;
    scene.materials = {material("left", 1000., nu), material("right", 1000. * contrast, nu)};
    scene.materials[1].regions = {1};
    // The wall is moved too, so that prescribed values matter.
    scene.supports = {support("wall", "x < 1e-9", "xyz", {{"0", "0", "0.001*y"}})};
    scene.loads    = {load("tip", LoadType::traction, "x > 5-1e-9", {{"0", "0", "-1"}})};
    return scene;
  }

  void
  compare(const std::string &name, scene::Scene scene, unsigned int degree, unsigned int most)
  {
    const unsigned int n    = degree == 1 ? 6 : 3;
    const auto         body = box(Point<3>(5, 1, 1), {{4 * n, n, n}}, 0.2, 2.5);
    scene.solver.type       = SolverType::direct;
    const auto direct       = solve_scene(scene, body, degree);
    scene.solver.type       = SolverType::cg;
    scene.solver.tolerance  = 1e-9;
    const auto iterative    = solve_scene(scene, body, degree);
    std::cout << name << ", P" << degree << ": " << direct.n_dofs << " unknowns\n  "
              << direct.solver << ", " << iterative.solver << '\n';
    check("  equal to 1e-6", distance(*direct.whole, *iterative.whole) < 1e-6);
    check("  energy", iterative.energy, direct.energy, direct.energy, 1e-7);
    const bool few = iterative.iterations >= 5 && iterative.iterations <= most;
    std::cout << "  iterations between 5 and " << most << ": "
              << (few ? "yes" : "NO, " + std::to_string(iterative.iterations)) << '\n';
    check("  none for the direct solver", direct.iterations == 0);

    const auto again = solve_scene(scene, body, degree, iterative.whole.get());
    // None, but for rounding.
    check("  few more from the solution", 4 * again.iterations <= iterative.iterations);
    scene.solver.max_iterations = 3;
    try
      {
        solve_scene(scene, body, degree);
        std::cout << "  CONVERGED IN 3 ITERATIONS\n";
      }
    catch (const core::NumericalError &failure)
      {
        const std::string text = failure.what();
        std::cout << "  " << text.substr(0, text.find(" the residual")) << "...\n";
      }
  }

  void
  choice()
  {
    scene::Scene scene = cantilever(0.3, 1.);
    const auto   body  = box(Point<3>(5, 1, 1), {{10, 2, 2}}, 0., 2.5);
    for (const unsigned int limit : {296u, 297u})
      {
        scene.solver.direct_limit = limit;
        const auto result         = solve_scene(scene, body, 1);
        std::cout << result.n_dofs << " unknowns, at most " << limit
                  << " for the direct solver: " << result.solver << '\n';
      }
    scene.supports[0].displacement   = {{"0.5", "0", "0"}};
    scene.supports[0].selector.where = "1";
    scene.loads.clear();
    scene.solver.type = SolverType::cg;
    // All surface points moved alike: the rest follows.
    const auto moved = solve_scene(scene, body, 1);
    double     error = 0.;
    for (const auto &u : moved.whole->values)
      error = std::max(error, (u - Tensor<1, 3>({0.5, 0., 0.})).norm());
    check("moved as a whole", error, 0., 0.5, 1e-8);
    scene.supports[0].displacement = {{"0", "0", "0"}};
    std::cout << "no load: " << solve_scene(scene, body, 1).solver << '\n';
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int degree : {1, 2})
    {
      compare("one material", cantilever(0.3, 1.), degree, 30);
      compare("a thousand times stiffer half", cantilever(0.3, 1e3), degree, 40);
    }
  compare("nearly incompressible", cantilever(0.49, 1.), 2, 80);
  for (const unsigned int degree : {1, 2})
    {
      scene::Scene scene     = cantilever(0.3, 1e3);
      scene.solver.multigrid = scene::SolverParameters::Multigrid::trilinos;
      compare("multigrid of Trilinos", scene, degree, 60);
    }
  choice();
}
