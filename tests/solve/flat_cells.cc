// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Flat and long quadratic tetrahedra, as plates, walls and bars have: conjugate gradients
// find what the direct solver finds in few iterations, however the body is turned; ordinary
// cells are left alone; and where nothing helps, that is seen in time.

#include "tetradapt/fem/triangulation.h"
#include "tetradapt/solve/flat_nodes.h"

#include "solving.h"

#include <deal.II/base/mpi.h>

using namespace bodies;
using scene::LoadType;

namespace
{
  using Body = std::shared_ptr<mesh::TetMesh>;

  /** Bricks with edges of length one but for those along z, which are @p ratio times shorter. */
  Body
  plate(const unsigned int n, const unsigned int layers, const double ratio, const double amount)
  {
    return box(Point<3>(n, n, layers / ratio), {{n, n, layers}}, amount);
  }

  /** Iterations and energies of @p scene on @p body. */
  void
  compare(const std::string &name, scene::Scene scene, const Body &body, const unsigned int most)
  {
    scene.solver.type   = SolverType::direct;
    const double energy = solve_scene(scene, body, 2).energy;
    scene.solver.type   = SolverType::cg;
    const auto solution = solve_scene(scene, body, 2);
    const bool few      = solution.iterations > 0 && solution.iterations <= most;
    std::cout << name << ": at most " << most
              << " iterations: " << (few ? "yes" : "NO, " + std::to_string(solution.iterations))
              << '\n';
    check("  energy", solution.energy, energy, energy, 1e-6);
  }

  scene::Scene
  held_at_sides(const unsigned int n)
  {
    scene::Scene scene;
    scene.materials = {material("all", 1000., 0.3)};
    scene.supports  = {support("sides", "x < 1e-9 || y > " + std::to_string(n) + " - 1e-9")};
    scene.loads     = {load("weight", LoadType::body_force, "", {{"0", "0", "-1e-3"}})};
    return scene;
  }

  void
  plates()
  {
    constexpr unsigned int n = 8;
    for (const unsigned int layers : {1, 2, 4})
      for (const double ratio : {5., 20.})
        compare(std::to_string(layers) + " layers, ratio " + std::to_string(int(ratio)),
                held_at_sides(n),
                plate(n, layers, ratio, 0.),
                ratio < 10. ? 60 : 150);
    for (const double ratio : {5., 20.})
      compare("2 distorted layers, ratio " + std::to_string(int(ratio)),
              held_at_sides(n),
              plate(n, 2, ratio, 0.25),
              ratio < 10. ? 60 : 150);
    auto scene                       = held_at_sides(n);
    scene.supports[0].selector.where = "z < 1e-9";
    compare("held at its bottom, ratio 20", scene, plate(n, 2, 20., 0.25), 60);
  }

  /** The plate turned about an axis that is none of its own. */
  void
  turned()
  {
    constexpr unsigned int n    = 8;
    const auto             body = plate(n, 1, 20., 0.);
    // Rodrigues' formula: R = 1 + sin K + (1 - cos) K K, with K x = axis x x.
    const Tensor<1, 3> axis = Tensor<1, 3>({1., 2., 3.}) / std::sqrt(14.);
    Tensor<2, 3>       R;
    for (unsigned int d = 0; d < 3; ++d)
      {
        Tensor<1, 3> unit;
        unit[d]         = 1.;
        const auto once = cross_product_3d(axis, unit);
        const auto rotated
          = unit + std::sin(0.8) * once + (1. - std::cos(0.8)) * cross_product_3d(axis, once);
        for (unsigned int i = 0; i < 3; ++i)
          R[i][d] = rotated[i];
      }
    for (auto &p : body->points)
      p = Point<3>(R * Tensor<1, 3>(p));
    mesh::finalize(*body, "turned");
    const auto along = [&](const unsigned int d) {
      std::string text;
      for (unsigned int i = 0; i < 3; ++i)
        text += (i > 0 ? " + (" : "(") + std::to_string(R[i][d]) + ")*" + "xyz"[i];
      return "(" + text + ")";
    };
    auto scene                       = held_at_sides(n);
    scene.supports[0].selector.where = along(0) + " < 1e-3 || " + along(1) + " > 8 - 1e-3";
    compare("turned, ratio 20", scene, body, 150);
  }

  /** Cells ten times longer than thick, along a bar. */
  void
  bar()
  {
    scene::Scene scene;
    scene.materials = {material("all", 1000., 0.3)};
    scene.supports  = {support("wall", "x < 1e-9")};
    scene.loads     = {load("weight", LoadType::body_force, "", {{"0", "0", "-1e-6"}})};
    compare("bar, ratio 10", scene, box(Point<3>(200, 2, 2), {{20, 2, 2}}, 0.), 60);
  }

  bool
  is_flat(const Body &body)
  {
    const auto triangulation    = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
    const mesh::EdgeTable edges = mesh::build_edges(*body);
    const fem::Space      space(triangulation, 2);
    return solve::find_flat_nodes(space).exist;
  }

  void
  detection()
  {
    check("cubes are flat", is_flat(plate(4, 4, 1., 0.)));
    check("one layer of cubes", is_flat(plate(6, 1, 1., 0.)));
    check("distorted cubes", is_flat(plate(4, 4, 1., 0.3)));
    check("ratio 5", is_flat(plate(4, 4, 5., 0.)));
    check("distorted, ratio 5", is_flat(plate(4, 4, 5., 0.25)));
  }

  /** Ratio 1 000: given up in time and factorised. */
  void
  too_flat()
  {
    auto       scene          = held_at_sides(12);
    const auto body           = plate(12, 1, 1000., 0.);
    scene.solver.direct_limit = 0;
    std::cout << "ratio 1 000: " << solve_scene(scene, body, 2).solver << '\n';
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    std::cout.setstate(std::ios::failbit);
  plates();
  turned();
  bar();
  detection();
  too_flat();
}
