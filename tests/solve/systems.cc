// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A system that is kept: dual solutions, conjugate gradients that stop at the error
// that is allowed, and an energy that hardly feels it.

#include "tetradapt/fem/replication.h"
#include "tetradapt/solve/energies.h"

#include "solving.h"

#include <deal.II/base/mpi.h>

using namespace bodies;
using scene::LoadType;

namespace
{
  /** Energy norm of the difference of two fields of one space. */
  double
  distance(const fem::Field &a, const fem::Field &b, const mechanics::MaterialMap &m)
  {
    fem::Vector difference(a.vector());
    difference -= b.vector();
    return std::sqrt(solve::compute_energies(fem::Field(a.shared_space(), difference), m).energy);
  }

  scene::Scene
  cantilever(const SolverType type)
  {
    scene::Scene scene;
    scene.materials        = {material("all", 1000., 0.3)};
    scene.supports         = {support("wall", "x < 1e-9")};
    scene.loads            = {load("tip", LoadType::traction, "x > 5-1e-9", {{"0", "0", "-1"}})};
    scene.solver.type      = type;
    scene.solver.tolerance = 1e-10;
    return scene;
  }

  /** Betti: the forces of one problem on the displacement of the other. */
  void
  duals(const SolverType type, const unsigned int degree)
  {
    const scene::Scene scene = cantilever(type);
    const auto         body  = box(Point<3>(5, 1, 1), {{10, 2, 2}});
    select(*body, scene);
    const mechanics::MaterialMap materials(scene, *body);
    const solve::StaticSystem system(scene, materials, body, degree, MPI_COMM_WORLD, core::Log());
    const auto                solution = system.solve(nullptr, {});
    const fem::Space         &space    = *system.space();
    std::vector<Tensor<1, 3>> values(space.n_field_nodes());
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] = Tensor<1, 3>({std::sin(i), std::cos(3. * i), 1.});
    const fem::Vector forces = fem::distribute(space, values);
    const auto        dual   = system.solve_dual(forces, {});
    const double      goal   = forces * solution.displacement->vector();
    double            moved  = 0.;
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      if (system.prescribed().is_fixed(space.field_node(node), 0))
        moved = std::max(moved, dual->value(node).norm());
    std::cout << solution.solver << ", P" << degree << '\n';
    check("  goal by the dual", system.nodal_forces() * dual->vector(), goal, std::abs(goal), 1e-7);
    check("  the dual rests at supports", moved == 0.);
    check("  and again from the first solution",
          distance(*system.solve(solution.displacement.get(), {}).displacement,
                   *solution.displacement,
                   materials)
            < 1e-7 * std::sqrt(solution.energy));
  }

  void
  stopping(const unsigned int degree)
  {
    const scene::Scene scene = cantilever(SolverType::cg);
    const unsigned int n     = degree == 1 ? 6 : 3;
    const auto         body  = box(Point<3>(5, 1, 1), {{5 * n, n, n}});
    select(*body, scene);
    const mechanics::MaterialMap materials(scene, *body);
    const solve::StaticSystem system(scene, materials, body, degree, MPI_COMM_WORLD, core::Log());
    const auto                exact = system.solve(nullptr, {});
    const double              norm  = std::sqrt(exact.energy);
    // A first iterate that is far from the solution in every respect.
    const fem::Space &space = *system.space();
    fem::Vector       values(exact.displacement->vector());
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        values.local_element(3 * node + c)
          *= 0.9 + 0.05 * std::sin(7. * space.node_position(node)[0]);
    const fem::Field start(system.space(), values);

    std::cout << "P" << degree << ", " << exact.n_dofs << " unknowns\n";
    for (const double allowed : {1e-1, 1e-2, 1e-3})
      {
        solve::StaticSystem::Stop stop;
        stop.algebraic_error = allowed * norm;
        const auto   loose   = system.solve(&start, stop);
        const auto   tight   = system.solve(&start, {});
        const double error   = distance(*loose.displacement, *exact.displacement, materials);
        const double first_order
          = std::abs(solve::compute_energies(*loose.displacement, materials).energy - exact.energy);
        std::cout << "  allowed " << allowed << '\n';
        check("    error below twice that", error > 0. && error < 2. * stop.algebraic_error);
        check("    estimated between a half and twenty times",
              loose.algebraic_error > 0.5 * error && loose.algebraic_error < 20. * error);
        check("    saves a third at least", 3 * loose.iterations <= 2 * tight.iterations);
        check("    and says so to a third",
              std::abs(1. * loose.iterations_to_tolerance - tight.iterations)
                < 0.34 * tight.iterations);
        check("    energy lower by the error's square",
              exact.energy - loose.energy,
              error * error,
              error * error,
              1e-3);
        if (allowed < 0.1)
          check("    which a(u,u) is not", first_order > 2. * error * error);
      }
    solve::StaticSystem::Stop stop;
    stop.relative_error = 1e-3;
    const auto   dual   = system.solve_dual(system.nodal_forces(), stop);
    const double error  = distance(*dual, *exact.displacement, materials);
    check("  relative error of a dual", error > 1e-5 * norm && error < 2e-3 * norm);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const auto type : {SolverType::direct, SolverType::cg})
    for (const unsigned int degree : {1, 2})
      duals(type, degree);
  for (const unsigned int degree : {1, 2})
    stopping(degree);
}
