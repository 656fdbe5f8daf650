// SPDX-License-Identifier: AGPL-3.0-or-later
//
// All kinds of loads and supports at once, on one and on two ranks: the same
// golden numbers, to numdiff's 1e-8.

#include "solving.h"

#include <deal.II/base/mpi.h>

#include <iomanip>

using namespace bodies;
using scene::LoadType;

namespace
{
  scene::Scene
  everything()
  {
    scene::Scene scene;
    scene.materials            = {material("soft", 10., 0.4), material("hard", 1000., 0.2)};
    scene.materials[1].regions = {1};
    scene.materials[0].density = 1.;
    scene.materials[1].density = 2.;
    scene.materials[1].thermal_expansion = 1e-3;
    scene.supports = {support("wall", "x < 1e-9", "xyz", {{"0", "0.01*z", "0"}}),
                      support("rail", "y < 1e-9 && x > 2", "y")};
    scene.loads    = {load("weight", LoadType::gravity, "", {{"0", "0", "-0.1"}}),
                      load("tip", LoadType::traction, "x > 3-1e-9", {{"0.2", "0.1*z", "y"}}),
                      load("lid", LoadType::pressure, "z > 1-1e-9", {{"0.3*x", "", ""}}),
                      load("wind", LoadType::body_force, "", {{"0", "0.1*x", "0"}}),
                      load("heat", LoadType::temperature, "", {{"5 + y", "", ""}})};
    return scene;
  }

  void
  run(const unsigned int degree, const SolverType type, const bool print)
  {
    scene::Scene scene     = everything();
    scene.solver.type      = type;
    scene.solver.tolerance = 1e-12;
    const unsigned int n   = degree == 1 ? 8 : 4;
    const auto         result
      = solve_scene(scene, box(Point<3>(3, 1, 1), {{3 * n, n, n}}, 0.2, 1.5), degree);
    const auto &u       = result.whole->values;
    double      largest = 0., weighted = 0.;
    for (unsigned int node = 0; node < u.size(); ++node)
      {
        largest = std::max(largest, u[node].norm());
        weighted
          += u[node] * Tensor<1, 3>({std::sin(1. + node), std::cos(2. * node), 1.}) / u.size();
      }
    // Every rank must hold all of it.
    const auto range = dealii::Utilities::MPI::min_max_avg(weighted, MPI_COMM_WORLD);
    if (!print)
      return;
    std::cout << "P" << degree << ", " << result.n_dofs << " unknowns, " << result.solver << '\n'
              << std::setprecision(10) << "  energy " << result.energy << "\n  stored energy "
              << result.strain_energy << "\n  work " << result.external_work
              << "\n  largest displacement " << largest << "\n  weighted sum " << weighted << '\n';
    check("  the same on every rank", range.min == range.max);
  }

  /** So few cells that a rank owns nodes without their neighbours. */
  void
  few_cells(const unsigned int degree, const bool print)
  {
    scene::Scene scene     = everything();
    scene.solver.tolerance = 1e-12;
    scene.supports.resize(1); // the faces are too large for the rail
    const auto body        = box(Point<3>(3, 1, 1), {{2, 1, 1}}, 0., 1.5);
    scene.solver.type      = SolverType::direct;
    const auto direct      = solve_scene(scene, body, degree);
    scene.solver.type      = SolverType::cg;
    const auto iterative   = solve_scene(scene, body, degree);
    scene.solver.multigrid = scene::SolverParameters::Multigrid::trilinos;
    const auto trilinos    = solve_scene(scene, body, degree);
    if (print)
      check("the same with Trilinos' multigrid, P" + std::to_string(degree),
            trilinos.energy,
            direct.energy,
            std::abs(direct.energy),
            1e-9);
    if (print)
      check("a dozen cells, P" + std::to_string(degree) + ", energy",
            iterative.energy,
            direct.energy,
            std::abs(direct.energy),
            1e-9);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  for (const unsigned int degree : {1, 2})
    for (const SolverType type : {SolverType::cg, SolverType::direct})
      run(degree, type, first);
  for (const unsigned int degree : {1, 2})
    few_cells(degree, first);
}
