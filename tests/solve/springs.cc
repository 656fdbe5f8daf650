// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Springs: their matrix in all forms of the stiffness, exact solutions, what they add to energies
// and reactions, and what they hold.

#include "tetradapt/fem/replication.h"
#include "tetradapt/fem/triangulation.h"
#include "tetradapt/mechanics/matrix_free_stiffness.h"
#include "tetradapt/mechanics/rigid_motions.h"
#include "tetradapt/mechanics/stiffness.h"
#include "tetradapt/solve/energies.h"

#include "solving.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>

using namespace bodies;
using scene::LoadType;
using scene::SpringDirection;
using Vector3 = Tensor<1, 3>;

namespace
{
  bool first_rank;

  void
  expect(const std::string &what,
         const double       value,
         const double       exact,
         const double       scale,
         const double       tolerance = 1e-10)
  {
    if (first_rank)
      check("  " + what, value, exact, scale, tolerance);
  }

  void
  expect(const std::string &what, const Vector3 &value, const Vector3 &exact, const double scale)
  {
    expect(what, (value - exact).norm(), 0., scale, 1e-9);
  }

  void
  expect(const std::string &what, const bool holds)
  {
    if (first_rank)
      check("  " + what, holds);
  }

  void
  say(const std::string &what)
  {
    if (first_rank)
      std::cout << what << '\n';
  }

  scene::SupportParameters
  spring(const std::string                &name,
         const std::string                &where,
         const std::string                &stiffness,
         const SpringDirection             direction,
         const std::array<std::string, 3> &ground = {{"0", "0", "0"}})
  {
    scene::SupportParameters result = support(name, where);
    result.type                     = scene::SupportType::spring;
    result.components.fill(false);
    result.displacement     = ground;
    result.spring.stiffness = stiffness;
    result.spring.direction = direction;
    return result;
  }

  scene::Scene
  make_scene(const double nu, const SolverType solver)
  {
    scene::Scene scene;
    scene.materials            = {material("stuff", 20., nu)};
    scene.materials[0].density = 3.;
    scene.solver.type          = solver;
    scene.solver.tolerance     = 1e-12;
    return scene;
  }

  std::shared_ptr<mesh::TetMesh>
  selected(const scene::Scene &scene, const std::shared_ptr<mesh::TetMesh> &body)
  {
    auto result = std::make_shared<mesh::TetMesh>(*body);
    select(*result, scene);
    return result;
  }

  /** Of all kinds, some on faces whose nodes are also held, and two on the same faces. */
  std::vector<scene::SupportParameters>
  many_supports()
  {
    return {support("wall", "x < 1e-9", "y"),
            spring("bed", "x < 1e-9", "40 + 30*y", SpringDirection::all),
            spring("side", "y > 1-1e-9", "if(x < 0.7, 90, 1)", SpringDirection::normal),
            spring("top", "z > 1-1e-9 && x > 1", "7", SpringDirection::normal),
            spring("again", "z > 1-1e-9", "50", SpringDirection::all)};
  }

  double
  largest(double value)
  {
    return dealii::Utilities::MPI::max(value, MPI_COMM_WORLD);
  }

  /** Something on every unknown, the same whatever the number of ranks; on the middle of an edge
   * the mean of its ends. */
  template <typename Number>
  void
  fill(const fem::Space &space, mechanics::VectorOf<Number> &x)
  {
    const unsigned int n_points = space.tet_mesh().n_points();
    const auto         at       = [](const unsigned int point, const unsigned int c) {
      return std::sin(1. + 3. * point + c);
    };
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const unsigned int field_node = space.field_node(node);
          double             value      = 0.;
          if (field_node < n_points)
            value = at(field_node, c);
          else
            for (const unsigned int end : space.edge_table()->edges[field_node - n_points])
              value += 0.5 * at(end, c);
          x.local_element(3 * node + c) = static_cast<Number>(value);
        }
  }

  template <typename Number>
  void
  compare_products(const std::string                     &name,
                   const fem::Space                      &space,
                   const mechanics::TangentField         &tangents,
                   const fem::FixedUnknowns              &fixed,
                   const mechanics::SpringMatrix<double> &springs,
                   const double                           tolerance)
  {
    const auto assembled = mechanics::assemble(space, tangents, fixed, &springs);
    const mechanics::MatrixFreeStiffness<Number> matrix_free(space, tangents, fixed, 1., &springs);
    mechanics::VectorOf<Number>                  x(space.vector_layout()), y(x);
    mechanics::Vector                            X(space.vector_layout()), Y(X);
    fill(space, x);
    fill(space, X);
    matrix_free.vmult(y, x);
    assembled.matrix.vmult(Y, X);
    double worst = 0., scale = 0., diagonal = 0.;
    for (unsigned int i = 0; i < Y.locally_owned_size(); ++i)
      {
        worst = std::max(worst, std::abs(y.local_element(i) - Y.local_element(i)));
        scale = std::max(scale, std::abs(Y.local_element(i)));
      }
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int i = 0; i < 9; ++i)
        diagonal
          = std::max(diagonal,
                     std::abs(double(matrix_free.diagonal_blocks()[node][i])
                              - assembled.matrix.block(assembled.matrix.row_begin(node))[i]));
    expect(name + ", product", largest(worst), 0., largest(scale), tolerance);
    expect(name + ", diagonal", largest(diagonal), 0., largest(scale), tolerance);
  }

  /** The matrix-free stiffness is the assembled one, and degree 1 that of degree 2 in the subspace.
   */
  void
  matrices()
  {
    say("matrices");
    auto scene                        = make_scene(0.3, SolverType::cg);
    scene.supports                    = many_supports();
    const auto                   body = selected(scene, box(Point<3>(2, 1, 1), {{3, 2, 2}}));
    const mechanics::MaterialMap materials(scene, *body);
    const auto triangulation = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
    const mechanics::TangentField tangents(materials, *body);
    const mesh::EdgeTable         edges = mesh::build_edges(*body);
    const fem::Space              space(triangulation, 2);
    const mechanics::Springs      springs(scene, *body);
    const auto                    matrix = mechanics::make_spring_matrix(springs, space);
    const fem::FixedUnknowns      fixed(
      space,
      mechanics::make_constraints(mechanics::prescribe(scene.supports, *body, &edges), space));
    compare_products<double>("double precision", space, tangents, fixed, matrix, 1e-14);
    compare_products<float>("single precision", space, tangents, fixed, matrix, 1e-6);

    // Without supports: those fix middles, which are means here.
    fem::Constraints none = fem::make_constraints(space);
    none.close();
    const auto               linear = fem::Space::linear_part(space);
    const fem::FixedUnknowns nothing(space, none),
      nothing_linear(*linear, fem::restrict_to(*linear, space, none));
    const auto energy = [](const fem::Space &s, const mechanics::LinearSystem &system) {
      mechanics::Vector x(s.vector_layout()), y(x);
      fill(s, x);
      system.matrix.vmult(y, x);
      return x * y;
    };
    const auto   linear_springs = mechanics::make_spring_matrix(springs, *linear);
    const double fine
      = energy(space, mechanics::assemble(space, tangents, nothing, &matrix)),
      body_alone = energy(space, mechanics::assemble(space, tangents, nothing)),
      coarse
      = energy(*linear, mechanics::assemble(*linear, tangents, nothing_linear, &linear_springs));
    expect("degree 1 in degree 2", coarse, fine, fine, 1e-13);
    expect("springs count", fine > 1.01 * body_alone);
  }

  struct Solved
  {
    solve::StaticSolution                   solution;
    std::shared_ptr<const mesh::NodalField> displacement; ///< on every rank
    solve::Equilibrium                      forces;
  };

  Solved
  solved(const scene::Scene                   &scene,
         const std::shared_ptr<mesh::TetMesh> &body,
         const unsigned int                    degree)
  {
    const auto                   mesh = selected(scene, body);
    const mechanics::MaterialMap materials(scene, *mesh);
    const solve::StaticSystem system(scene, materials, mesh, degree, MPI_COMM_WORLD, core::Log());
    Solved                    result{system.solve(nullptr, {}), nullptr, {}};
    const auto                regions
      = mechanics::compute_region_figures(*result.solution.displacement, materials);
    result.displacement = fem::replicate(*result.solution.displacement);
    result.forces       = system.equilibrium(result.solution, regions);
    expect("balance", result.forces.is_balanced() && result.forces.relative_imbalance < 1e-9);
    return result;
  }

  double
  largest_error(const mesh::NodalField &u, const std::function<Vector3(const Point<3> &)> &exact)
  {
    double worst = 0.;
    for (unsigned int node = 0; node < u.n_nodes(); ++node)
      worst = std::max(worst, (u.values[node] - exact(u.node_position(node))).norm());
    return worst;
  }

  /** A bar on a base of springs under a force: u = F/(k A) + F x/(E A). */
  void
  bar(const unsigned int degree, const SolverType solver)
  {
    auto scene         = make_scene(0., solver);
    scene.supports     = {spring("base", "x < 1e-9", "50", SpringDirection::all)};
    scene.loads        = {load("end", LoadType::traction, "x > 2-1e-9", {{"3", "0", "0"}})};
    const auto  result = solved(scene, box(Point<3>(2, 1, 1), {{5, 3, 3}}), degree);
    const auto &u      = result.solution;
    expect("displacement",
           largest_error(*result.displacement,
                         [](const Point<3> &x) {
                           return Vector3({3. / 50. + 3. * x[0] / 20., 0., 0.});
                         }),
           0.,
           0.36);
    expect("energy of the body", u.strain_energy, 0.5 * 9. * 2. / 20., 0.45);
    expect("energy of the springs", *u.spring_energy, 0.5 * 9. / 50., 0.09);
    expect("energy of both", u.energy, 9. * (2. / 20. + 1. / 50.), 1.);
    expect("norm", u.norm.value, std::sqrt(9. * 2. / 20.), 1.);
    const auto &base = result.forces.supports[0];
    expect("force of the springs", base.resultant.force, Vector3({-3., 0., 0.}), 3.);
    expect("its moment", base.resultant.moment, Vector3({0., -1.5, 1.5}), 3.);
    expect("kind", base.kind == "spring");
    expect("area", base.extent.area, 1., 1.);
  }

  /** A ground that moves and turns as a whole takes the body along, without any stress; and one
   * that moves against a fixed wall stretches it. */
  void
  moved_ground(const unsigned int degree, const SolverType solver)
  {
    auto scene     = make_scene(0.3, solver);
    scene.supports = {
      spring("bed", "z < 1e-9", "30 + 20*x", SpringDirection::all, {{"1 - 0.1*y", "0.1*x", "2"}})};
    const auto body   = box(Point<3>(2, 1, 1), {{4, 2, 2}});
    auto       result = solved(scene, body, degree);
    expect("as a whole",
           largest_error(*result.displacement,
                         [](const Point<3> &x) {
                           return Vector3({1. - 0.1 * x[1], 0.1 * x[0], 2.});
                         }),
           0.,
           2.);
    expect("no force", result.forces.supports[0].resultant.force, Vector3(), 30. * 4.);
    expect("no energy", *result.solution.spring_energy, 0., 30.);

    scene = make_scene(0., solver);
    scene.supports
      = {support("x", "x < 1e-9", "x"),
         support("y", "y < 1e-9", "y"),
         support("z", "z < 1e-9", "z"),
         spring("pull", "x > 2-1e-9", "50", SpringDirection::normal, {{"0.4", "5", "6"}})};
    result = solved(scene, body, degree);
    // The springs' stiffness is in series with E / L = 10: 50/60 of the way is the body's.
    const double strain = 0.4 * 50. / 60. / 2.;
    expect("stretched",
           largest_error(*result.displacement,
                         [&](const Point<3> &x) {
                           return Vector3({strain * x[0], 0., 0.});
                         }),
           0.,
           0.4);
    expect("force of the wall",
           result.forces.supports[0].resultant.force,
           Vector3({-20. * strain, 0., 0.}),
           4.);
    expect("force of the springs",
           result.forces.supports[3].resultant.force,
           Vector3({20. * strain, 0., 0.}),
           4.);
  }

  /** A block under its weight, on springs and held at nodes that have springs as well: whatever the
   * displacement, the forces balance the weight. */
  void
  weight(const unsigned int degree, const SolverType solver)
  {
    auto scene        = make_scene(0.3, solver);
    scene.supports    = many_supports();
    scene.loads       = {load("weight", LoadType::gravity, "", {{"1", "-10", "2"}})};
    const auto result = solved(scene, box(Point<3>(2, 1, 1), {{4, 3, 2}}), degree);
    Vector3    sum, moment;
    for (const auto &entry : result.forces.supports)
      {
        sum += entry.resultant.force;
        moment += entry.resultant.moment;
      }
    const Vector3 all({6., -60., 12.});
    expect("forces", sum, -all, 60.);
    expect("moments", moment, -cross_product_3d(Vector3({1., .5, .5}), all), 60.);
    expect("all have some", result.forces.supports[0].resultant.force.norm() > 1.);
    for (unsigned int s = 1; s < 5; ++s)
      expect("  " + result.forces.supports[s].name,
             result.forces.supports[s].resultant.force.norm() > 0.01);
    const Vector3 side = result.forces.supports[2].resultant.force;
    expect("normal springs", std::hypot(side[0], side[2]), 0., 60.);
  }

  /** The energies of nested spaces differ by the square of the norm of the difference, in which the
   * springs count. */
  void
  nested_energies(const bool moves)
  {
    auto scene     = make_scene(0.3, SolverType::direct);
    scene.supports = many_supports();
    if (moves)
      scene.supports[1].displacement = {{"0.1*y*z", "0.2 + x", "z^2"}};
    else
      scene.loads = {load("weight", LoadType::gravity, "", {{"1", "-10", "2"}})};
    const auto       body   = box(Point<3>(2, 1, 1), {{3, 2, 2}});
    const auto       linear = solved(scene, body, 1), quadratic = solved(scene, body, 2);
    mesh::NodalField difference = *quadratic.displacement;
    const auto      &edges      = difference.edges().edges;
    const auto      &u          = linear.displacement->values;
    for (unsigned int i = 0; i < u.size(); ++i)
      difference.values[i] -= u[i];
    for (unsigned int e = 0; e < edges.size(); ++e)
      difference.values[u.size() + e] -= 0.5 * (u[edges[e][0]] + u[edges[e][1]]);
    const auto                   distributed = fem::distribute(difference, MPI_COMM_WORLD);
    const mechanics::MaterialMap materials(scene, difference.mesh());
    const double                 of_body = solve::compute_energies(*distributed, materials).energy;
    for (auto &support : scene.supports)
      support.displacement.fill("0");
    const mechanics::Springs at_rest(scene, difference.mesh());
    const double of_springs = 2. * mechanics::spring_forces(at_rest, *distributed).energy;
    const double gap = (moves ? -1. : 1.) * (quadratic.solution.energy - linear.solution.energy);
    expect(moves ? "moved ground" : "loads", gap, of_body + of_springs, gap, 1e-8);
    expect("springs count", of_springs > 0.01 * gap);
  }

  void
  refused(const std::string &what, const std::vector<scene::SupportParameters> &supports)
  {
    auto scene      = make_scene(0.3, SolverType::direct);
    scene.supports  = supports;
    const auto body = selected(scene, box(Point<3>(2, 1, 1), {{2, 2, 2}}, 0.));
    try
      {
        mechanics::check_springs(scene, *body);
        say("  " + what + ": held");
      }
    catch (const core::InputError &error)
      {
        say("  " + what + ": " + error.what());
      }
  }

  void
  rigid_motions()
  {
    say("rigid motions");
    const auto n = SpringDirection::normal;
    refused("one flat face, all directions",
            {spring("base", "z < 1e-9", "1", SpringDirection::all)});
    refused("one flat face, along the normal", {spring("base", "z < 1e-9", "1", n)});
    refused("two, along the normals",
            {spring("base", "z < 1e-9", "1", n), spring("wall", "x < 1e-9", "1e3", n)});
    refused("three, along the normals",
            {spring("base", "z < 1e-9", "1", n),
             spring("wall", "x < 1e-9", "1e3", n),
             spring("side", "y < 1e-9", "1e-3", n)});
    refused("a fixed edge of faces and one along the normal",
            {support("wall", "x < 1e-9", "yz"), spring("base", "x < 1e-9", "1", n)});
    refused("very soft", {spring("base", "z < 1e-9", "1e-12", SpringDirection::all)});
    refused("negative somewhere", {spring("base", "z < 1e-9", "x - 0.1", SpringDirection::all)});
    refused("zero", {spring("base", "z < 1e-9", "if(x > 3, 1, 0)", SpringDirection::all)});
  }

  /** Conjugate gradients need about as many steps on springs of any stiffness as with a fixed
   * support. */
  void
  iterations(const unsigned int degree)
  {
    auto scene               = make_scene(0.3, SolverType::cg);
    scene.solver.tolerance   = 1e-8;
    scene.loads              = {load("end", LoadType::traction, "x > 4-1e-9", {{"0", "0", "1"}})};
    const auto body          = box(Point<3>(4, 1, 1), {{20, 5, 5}});
    scene.supports           = {support("wall", "x < 1e-9")};
    const unsigned int fixed = solved(scene, body, degree).solution.iterations;
    for (const std::string k : {"1e-3", "1", "1e3", "1e6", "1e12"})
      {
        scene.supports        = {spring("wall", "x < 1e-9", k, SpringDirection::all)};
        const unsigned int it = solved(scene, body, degree).solution.iterations;
        const bool         ok = it <= 2 * fixed + 4;
        expect("stiffness " + k + ": at most twice as many and 4", ok);
        if (!ok && first_rank)
          std::cout << it << " instead of " << fixed << '\n';
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  matrices();
  for (const unsigned int degree : {1, 2})
    for (const SolverType solver : {SolverType::direct, SolverType::cg})
      {
        say("P" + std::to_string(degree)
            + (solver == SolverType::direct ? ", direct" : ", conjugate gradients"));
        bar(degree, solver);
        moved_ground(degree, solver);
        weight(degree, solver);
      }
  say("nested energies");
  nested_energies(false);
  nested_energies(true);
  rigid_motions();
  for (const unsigned int degree : {1, 2})
    {
      say("iterations, P" + std::to_string(degree));
      iterations(degree);
    }
}
