// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Systems at the edge of what can be solved: bodies that are free to move, although
// nobody refused them before; soft, long and flat ones, which are solved; and iterations
// that are too many.

#include "tetradapt/fem/replication.h"
#include "tetradapt/fem/triangulation.h"
#include "tetradapt/solve/linear_solver.h"

#include "solving.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>

using namespace bodies;
using scene::LoadType;

namespace
{
  /** Solves with supports that are not checked: those on the points where @p is_held. */
  std::string
  unchecked(const SolverType                             type,
            const unsigned int                           degree,
            const std::function<bool(const Point<3> &)> &is_held)
  {
    scene::Scene scene;
    scene.materials                         = {material("all", 1000., 0.3)};
    scene.solver.type                       = type;
    scene.solver.max_iterations             = 300;
    const auto                        body  = box(Point<3>(3, 1, 1), {{6, 2, 2}});
    const mesh::EdgeTable             edges = mesh::build_edges(*body);
    const mechanics::MaterialMap      materials(scene, *body);
    mechanics::PrescribedDisplacement prescribed;
    prescribed.fixed.assign(body->n_points() + (degree == 2 ? edges.edges.size() : 0), 0);
    prescribed.values.resize(prescribed.fixed.size());
    for (unsigned int p = 0; p < body->n_points(); ++p)
      if (is_held(body->points[p]))
        prescribed.fixed[p] = 7;
    const auto triangulation = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
    const mechanics::TangentField tangents(materials, *body);
    const fem::Space              space(triangulation, degree);
    try
      {
        const core::Log           log;
        const auto                constraints = mechanics::make_constraints(prescribed, space);
        const solve::LinearSolver solver({space, tangents, constraints}, scene.solver, log);
        std::vector<Tensor<1, 3>> forces(space.n_field_nodes());
        for (unsigned int p = 0; p < body->n_points(); ++p)
          forces[p][2] = -1.; // not in balance
        solve::Vector x(space.vector_layout());
        solver.solve(solver.right_hand_side(fem::distribute(space, forces)), {}, "The loads", x);
        return "SOLVED";
      }
    catch (const core::NumericalError &error)
      {
        const std::string text = error.what();
        return text.substr(0, text.find_first_of(":0123456789"));
      }
  }

  void
  free_bodies()
  {
    for (const unsigned int degree : {1, 2})
      for (const SolverType type : {SolverType::direct, SolverType::cg})
        {
          std::cout << "P" << degree << (type == SolverType::cg ? ", cg" : ", direct")
                    << "\n  free: " << unchecked(type, degree, [](const auto &) { return false; })
                    << "\n  held in a line, free to turn: "
                    << unchecked(type,
                                 degree,
                                 [](const auto &p) { return p[0] == 0. && p[2] == 0.; })
                    << '\n';
        }
  }

  /** Energies of what is hard, but no singular system, against exact ones. */
  void
  hard_bodies()
  {
    // A bar of two halves, the one at the wall softer by nine orders.
    scene::Scene scene;
    scene.materials            = {material("soft", 1e-6, 0.), material("stiff", 1e3, 0.)};
    scene.materials[1].regions = {1};
    scene.supports             = {support("wall", "x < 1e-9")};
    scene.loads       = {load("tip", LoadType::traction, "x > 2-1e-9", {{"1e-9", "0", "0"}})};
    scene.solver.type = SolverType::direct;
    const auto   bar  = box(Point<3>(2, 1, 1), {{8, 4, 4}}, 0.2, 1.);
    const double work = 1e-9 * 1e-9 * (1. / 1e-6 + 1. / 1e3);
    check("soft half", solve_scene(scene, bar, 2).energy, work, work, 1e-6);

    // A bar 1 000 times longer than thick, in tension.
    scene.materials    = {material("all", 1e3, 0.)};
    scene.loads        = {load("tip", LoadType::traction, "x > 1000-1e-9", {{"1", "0", "0"}})};
    const auto slender = box(Point<3>(1000, 1, 1), {{1000, 1, 1}}, 0.);
    check("slender bar", solve_scene(scene, slender, 1).energy, 1., 1., 1e-6);
  }

  /** A plate of quadratic cells 125 times longer than thick, held at its rim. More such bodies:
   * tests/solve/flat_cells.cc. */
  void
  flat_cells()
  {
    scene::Scene scene;
    scene.materials           = {material("all", 1000., 0.3)};
    scene.supports            = {support("rim", "x < 1e-9 || y > 1-1e-9")};
    scene.loads               = {load("top", LoadType::pressure, "z > 0.002-1e-9", {{"1e-6"}})};
    scene.solver.direct_limit = 0;
    const auto plate          = box(Point<3>(1, 1, 0.002), {{4, 4, 1}}, 0.);
    const auto solution       = solve_scene(scene, plate, 2);
    scene.solver.type         = SolverType::direct;
    const double energy       = solve_scene(scene, plate, 2).energy;
    std::cout << "flat cells: " << solution.solver << '\n';
    check("  its energy", solution.energy, energy, energy, 1e-6);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  free_bodies();
  hard_bodies();
  flat_cells();
}
