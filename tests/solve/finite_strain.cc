// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Newton's method on bodies of laws that are not linear: its last residuals square, exact values
// of homogeneous states, finite rotations, loads that need steps, loads that no body bears, and
// another start. The same on one rank and on several.

#include "solving.h"

#include "tetradapt/fem/triangulation.h"
#include "tetradapt/mechanics/loads.h"
#include "tetradapt/solve/indefinite_matrix.h"
#include "tetradapt/solve/nonlinear_solver.h"

#include <deal.II/base/mpi.h>

using namespace bodies;

namespace
{
  bool
  is_first()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  void
  say(const std::string &what, const double value, const double exact, const double tolerance)
  {
    if (is_first())
      check("  " + what, value, exact, 1., tolerance);
  }

  /** Equations with a known solution: the fourth roots of 1, 2, ..., n. */
  void
  check_newton()
  {
    constexpr unsigned int n = 5;
    solve::Newton          newton;
    fem::Vector            jacobian(n);
    newton.residual = [](const fem::Vector &x, fem::Vector &r) {
      solve::Newton::State state;
      state.is_admissible = true;
      r.reinit(x);
      for (unsigned int i = 0; i < n; ++i)
        {
          const double y     = x.local_element(i);
          r.local_element(i) = (1. + i) - y * y * y * y;
          state.potential += std::pow(y, 5) / 5. - (1. + i) * y;
          state.is_admissible = state.is_admissible && y > 0.;
        }
      state.residual = r.l2_norm();
      state.scale    = 1.;
      return state;
    };
    newton.setup_jacobian = [&](const fem::Vector &x) {
      for (unsigned int i = 0; i < n; ++i)
        jacobian.local_element(i) = 4. * std::pow(x.local_element(i), 3);
    };
    newton.solve_with_jacobian
      = [&](const fem::Vector &, const fem::Vector &r, const double, fem::Vector &step) {
          for (unsigned int i = 0; i < n; ++i)
            step.local_element(i) = r.local_element(i) / jacobian.local_element(i);
          return 1u;
        };
    newton.moves_prescribed = [](const fem::Vector &) { return false; };
    solve::Newton::Limits limits;
    limits.tolerance = 1e-12;
    fem::Vector x(n);
    x                 = 0.3; // a whole step leads to 9 and more
    const auto result = newton.solve(limits, x);
    double     error  = 0.;
    for (unsigned int i = 0; i < n; ++i)
      error = std::max(error, std::abs(x.local_element(i) - std::pow(1. + i, 0.25)));
    say("roots", error, 0., 1e-13);
    const auto &r = result.residuals;
    say("residuals square",
        r.size() > 3 && r[r.size() - 2] < 2. * r[r.size() - 3] * r[r.size() - 3],
        1.,
        0.);
    say("steps are few", result.steps() < 15, 1., 0.);
    limits.max_steps = 2;
    x                = 0.3;
    say("too few steps are told",
        newton.solve(limits, x).ending == solve::Newton::Ending::too_slow,
        1.,
        0.);
    x = -1.;
    say("a start that is not admissible",
        newton.solve(limits, x).ending == solve::Newton::Ending::inadmissible,
        1.,
        0.);
    // A step that leads up.
    newton.solve_with_jacobian
      = [&](const fem::Vector &, const fem::Vector &right, const double, fem::Vector &step) {
          for (unsigned int i = 0; i < n; ++i)
            step.local_element(i) = -1e-3 * right.local_element(i);
          return 1u;
        };
    limits.max_steps = 50;
    x                = 2.;
    say("a derivative that is not positive",
        newton.solve(limits, x).ending == solve::Newton::Ending::indefinite,
        1.,
        0.);
    newton.solve_with_jacobian
      = [](const fem::Vector &, const fem::Vector &, double, fem::Vector &) -> unsigned int {
      throw solve::IndefiniteMatrix();
    };
    say("a linear solver that finds it so",
        newton.solve(limits, x).ending == solve::Newton::Ending::indefinite,
        1.,
        0.);
  }

  scene::Scene
  scene_of(const std::string &law, const laws::Constants &constants)
  {
    scene::Scene scene;
    scene.formulation            = scene::Formulation::finite_strain;
    scene.materials              = {material("tissue", 1., 0.)};
    scene.materials[0].law       = law;
    scene.materials[0].constants = constants;
    scene.solver.tolerance       = 1e-12;
    return scene;
  }

  /** A box on rollers, pulled to the stretch @p stretch; the sides are free. */
  void
  check_stretched(const unsigned int degree, const double stretch)
  {
    const double E = 3., nu = 0.25, mu = 1.2, lambda = 1.2;
    auto         scene = scene_of("neo-Hookean", {{"Young modulus", E}, {"Poisson ratio", nu}});
    scene.supports
      = {support("left", "x < 1e-9", "x"),
         support("front", "y < 1e-9", "y"),
         support("bottom", "z < 1e-9", "z"),
         support("right", "x > 2 - 1e-9", "x", {{std::to_string(2. * (stretch - 1.)), "0", "0"}})};
    const auto body     = box(Point<3>(2., 1., 1.), {{3, 2, 2}});
    const auto solution = solve_scene(scene, body, degree);
    // The sides' stretch b makes the stress on them zero: mu (b - 1/b) + lambda ln(J) / b = 0.
    double low = 0.1, high = 10.;
    for (unsigned int i = 0; i < 200; ++i)
      {
        const double b = 0.5 * (low + high);
        (mu * (b * b - 1.) + lambda * std::log(stretch * b * b) > 0. ? high : low) = b;
      }
    const double b = 0.5 * (low + high), J = stretch * b * b;
    double       error = 0.;
    const auto  &u     = *solution.whole;
    for (unsigned int node = 0; node < u.n_nodes(); ++node)
      {
        const auto x = u.node_position(node);
        error        = std::max(error,
                         (u.values[node]
                          - Tensor<1, 3>({(stretch - 1.) * x[0], (b - 1.) * x[1], (b - 1.) * x[2]}))
                           .norm());
      }
    const std::string what = "degree " + std::to_string(degree) + ", stretched to "
                             + std::to_string(stretch).substr(0, 3) + ": ";
    say(what + "displacement", error, 0., 1e-10);
    const double energy = 2.
                          * (0.5 * mu * (stretch * stretch + 2. * b * b - 3. - 2. * std::log(J))
                             + 0.5 * lambda * std::log(J) * std::log(J));
    say(what + "stored energy", solution.strain_energy, energy, 1e-10);
  }

  /** A box whose two ends are turned by 50 degrees and pulled by a tenth in the new
   * direction, against the same without turning. */
  void
  check_turned(const std::string &law)
  {
    const double angle = 50. / 180. * dealii::numbers::PI, c = std::cos(angle), s = std::sin(angle);
    auto         scene = scene_of(law, {{"Young modulus", 5.}, {"Poisson ratio", 0.3}});
    const auto   body  = box(Point<3>(3., 1., 1.), {{4, 2, 2}});
    std::array<double, 2> energies{};
    for (const bool turned : {false, true})
      {
        std::ostringstream cos, sin;
        cos.precision(17);
        sin.precision(17);
        cos << (turned ? c : 1.);
        sin << (turned ? s : 0.);
        const std::string stretched = "(x + 0.1*x)";
        const Texts       moved{{cos.str() + "*" + stretched + " - " + sin.str() + "*y - x",
                                 sin.str() + "*" + stretched + " + " + cos.str() + "*y - y",
                                 "0"}};
        scene.supports           = {support("left", "x < 1e-9", "xyz", moved),
                                    support("right", "x > 3 - 1e-9", "xyz", moved)};
        const auto solution      = solve_scene(scene, body, 2);
        energies[turned ? 1 : 0] = solution.strain_energy;
      }
    say(law + ": energy of a turned body", energies[1] / energies[0], 1., 1e-9);
    say(law + ": there is some", energies[0] > 1e-3, 1., 0.);
  }

  /** A beam bent so far that the whole load at once needs help; potential energy, and forces. */
  void
  check_beam(const unsigned int degree)
  {
    auto scene     = scene_of("neo-Hookean", {{"Young modulus", 1000.}, {"Poisson ratio", 0.3}});
    scene.supports = {support("wall", "x < 1e-9")};
    scene.loads    = {load("tip", scene::LoadType::traction, "x > 10 - 1e-9", {{"0", "0", "-3"}})};
    scene.solver.type   = SolverType::direct;
    const auto body     = box(Point<3>(10., 1., 1.), {{12, 2, 2}}, 0.);
    const auto solution = solve_scene(scene, body, degree);
    double     lowest   = 0.;
    for (const auto &u : solution.whole->values)
      lowest = std::min(lowest, u[2]);
    // From the solution no step is left to do.
    const auto again = solve_scene(scene, body, degree, solution.whole.get());
    say("from there no step is needed", again.solver.find(" 0 steps") != std::string::npos, 1., 0.);
    say("the same energy", again.strain_energy / solution.strain_energy, 1., 1e-9);
    // Iterations lead to the same place.
    scene.solver.type    = SolverType::cg;
    const auto iterative = solve_scene(scene, body, degree);
    say("by conjugate gradients", iterative.strain_energy / solution.strain_energy, 1., 1e-9);
    say("iterations", iterative.iterations > 0, 1., 0.);
    if (is_first())
      {
        std::cout.precision(9);
        std::cout << "  tip " << lowest << ", energy " << solution.strain_energy << ", potential "
                  << -0.5 * solution.energy << '\n';
      }
  }

  /** Near the solution each residual is about the square of the one before, for each law. */
  void
  check_quadratic(const std::string     &law,
                  const laws::Constants &constants,
                  const unsigned int     degree)
  {
    auto scene     = scene_of(law, constants);
    scene.supports = {support("wall", "x < 1e-9")};
    scene.loads = {load("pull", scene::LoadType::traction, "x > 2 - 1e-9", {{"0.1", "0", "0.02"}})};
    scene.solver.type = SolverType::direct;
    const auto body   = box(Point<3>(2., 1., 1.), {{3, 2, 2}});
    select(*body, scene);
    const mechanics::MaterialMap materials(scene, *body);
    const auto                   edges = mesh::build_edges(*body);
    const auto triangulation = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
    const fem::Space space(triangulation, degree);
    const auto       prescribed
      = mechanics::prescribe(scene.supports, *body, degree == 2 ? &edges : nullptr);
    const auto             forces = mechanics::assemble_loads(scene, materials, space).forces;
    const core::Log        log;
    solve::NonlinearSolver solver({space, materials, prescribed, forces}, scene.solver, log);
    fem::Vector            x(space.vector_layout());
    const auto             result = solver.solve(x);
    const auto            &r      = result.residuals;
    bool                   square = r.size() > 4;
    unsigned int           seen   = 0;
    for (unsigned int k = 0; k + 1 < r.size(); ++k)
      if (r[k] < 1e-2 && r[k] > 1e-7)
        {
          ++seen;
          square = square && r[k + 1] < 20. * r[k] * r[k];
        }
    say(law + ", degree " + std::to_string(degree) + ": residuals square",
        square && seen > 0,
        1.,
        0.);
  }

  /** Nothing but rounding acts on a body that is only moved; and tiny loads are still loads. */
  void
  check_rounding()
  {
    auto       scene = scene_of("neo-Hookean", {{"Young modulus", 2e11}, {"Poisson ratio", 0.3}});
    const auto body  = box(Point<3>(2., 1., 1.), {{3, 2, 2}});
    scene.supports   = {support("left", "x < 1e-9", "xyz", {{"0.3", "0", "-0.2"}})};
    const auto moved = solve_scene(scene, body, 2);
    double     error = 0.;
    for (const auto &u : moved.whole->values)
      error = std::max(error, (u - Tensor<1, 3>({0.3, 0., -0.2})).norm());
    say("only moved", error, 0., 1e-12);
    const Texts turned{{"-0.5*x - sqrt(0.75)*y", "sqrt(0.75)*x - 0.5*y", "0"}};
    scene.supports      = {support("left", "x < 1e-9", "xyz", turned)};
    error               = 0.;
    const auto solution = solve_scene(scene, body, 1);
    for (unsigned int node = 0; node < solution.whole->n_nodes(); ++node)
      {
        const auto x = solution.whole->node_position(node);
        error        = std::max(error,
                         (solution.whole->values[node]
                          - Tensor<1, 3>({-0.5 * x[0] - std::sqrt(0.75) * x[1],
                                                 std::sqrt(0.75) * x[0] - 0.5 * x[1],
                                                 0.}))
                           .norm());
      }
    say("only turned", error, 0., 1e-10);
    // The energy of small loads goes with their square.
    scene.supports = {support("left", "x < 1e-9")};
    std::vector<double> energies;
    for (const std::string size : {"1e-12", "1e-3"})
      {
        scene.loads = {load("pull",
                            scene::LoadType::traction,
                            "x > 2 - 1e-9",
                            {{"2e11*" + size, "0", "1e10*" + size}})};
        energies.push_back(solve_scene(scene, body, 2).strain_energy
                           / std::pow(std::stod(size), 2));
      }
    say("energy of tiny loads", energies[0] / energies[1], 1., 5e-3);
  }

  /** A column under twice the load at which it buckles is in equilibrium, but not stable. */
  void
  check_column(const SolverType solver)
  {
    auto scene        = scene_of("neo-Hookean", {{"Young modulus", 1000.}, {"Poisson ratio", 0.3}});
    scene.solver.type = solver;
    scene.supports    = {support("foot", "z < 1e-9")};
    // Euler: pi^2 E I / (2 l)^2 = 0.514 for l = 20.
    scene.loads = {load("weight", scene::LoadType::traction, "z > 20 - 1e-9", {{"0", "0", "-1"}})};
    const auto body = box(Point<3>(1., 1., 20.), {{1, 1, 10}}, 0.);
    try
      {
        const auto solution = solve_scene(scene, body, 2);
        if (is_first())
          std::cout << "  column: ACCEPTED\n";
      }
    catch (const core::NumericalError &error)
      {
        const std::string text = error.what(), before = "The body is in equilibrium up to ";
        const double      part = std::stod(text.substr(before.size()));
        say("column: the load it bears", part, 51.5, 3.);
        say("column: says that it is unstable", text.find("unstable") != std::string::npos, 1., 0.);
      }
  }

  void
  check_failure(const std::string &what, const scene::Scene &scene, const unsigned int degree)
  {
    const auto body = box(Point<3>(2., 1., 1.), {{3, 2, 2}});
    try
      {
        const auto solution = solve_scene(scene, body, degree);
        if (is_first())
          std::cout << "  " << what << ": ACCEPTED, " << solution.solver << '\n';
      }
    catch (const core::NumericalError &error)
      {
        if (is_first())
          std::cout << "  " << what << ": " << error.what() << '\n';
      }
  }

  /** Bars of St. Venant and Kirchhoff's law bear a compression of E/2 2/(3 sqrt 3) at most. */
  void
  check_limit()
  {
    auto scene = scene_of("St. Venant-Kirchhoff", {{"Young modulus", 1.}, {"Poisson ratio", 0.}});
    scene.supports      = {support("left", "x < 1e-9", "x"),
                           support("front", "y < 1e-9", "y"),
                           support("bottom", "z < 1e-9", "z")};
    const double limit  = 0.5 * 2. / (3. * std::sqrt(3.));
    scene.loads         = {load("press",
                        scene::LoadType::traction,
                        "x > 2 - 1e-9",
                        {{std::to_string(-0.98 * limit), "0", "0"}})};
    const auto body     = box(Point<3>(2., 1., 1.), {{3, 2, 2}});
    const auto solution = solve_scene(scene, body, 1);
    double     least    = 0.;
    for (const auto &u : solution.whole->values)
      least = std::min(least, u[0]);
    // P = E/2 l (l^2 - 1) by Newton's method in one number.
    double l = 0.7;
    for (unsigned int i = 0; i < 100; ++i)
      l -= (0.5 * l * (l * l - 1.) + std::stod(std::to_string(0.98 * limit))) / (1.5 * l * l - 0.5);
    say("just below the limit", least, 2. * (l - 1.), 1e-9);
    scene.loads[0].value[0] = std::to_string(-1.02 * limit);
    check_failure("just above", scene, 1);
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_newton();
  for (const unsigned int degree : {1u, 2u})
    for (const double stretch : {0.5, 1.1, 2.5})
      check_stretched(degree, stretch);
  check_turned("neo-Hookean");
  check_turned("St. Venant-Kirchhoff");
  for (const unsigned int degree : {1u, 2u})
    {
      check_quadratic("neo-Hookean", {{"Young modulus", 1.}, {"Poisson ratio", 0.3}}, degree);
      check_quadratic("split neo-Hookean", {{"Shear modulus", 0.4}, {"Bulk modulus", 1.}}, degree);
      check_quadratic("St. Venant-Kirchhoff",
                      {{"Young modulus", 1.}, {"Poisson ratio", 0.3}},
                      degree);
    }
  check_beam(1);
  check_beam(2);
  check_limit();
  check_rounding();
  check_column(SolverType::direct);
  check_column(SolverType::cg);
}
