// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Sliding and rigid supports against exact solutions: uniform stresses in inclined blocks, edges
// and corners, tension, bending and prescribed motions of rigid ends; reactions, iterations of
// conjugate gradients, and what is refused. The same on any number of ranks.

#include "solving.h"

#include "tetradapt/mechanics/supports.h"
#include "tetradapt/solve/static_system.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

using namespace bodies;
using scene::LoadType;
using scene::SupportType;

namespace
{
  bool first_rank;

  using Vector3 = Tensor<1, 3>;

  void
  expect(const std::string &what, const double value, const double tolerance)
  {
    if (first_rank)
      check("  " + what, value, 0., 1., tolerance);
  }

  void
  expect(const std::string &what, const bool holds)
  {
    if (first_rank)
      check("  " + what, holds);
  }

  struct Way
  {
    std::string  name;
    unsigned int degree;
    SolverType   solver;
  };

  const std::vector<Way> ways{{"P1, direct", 1, SolverType::direct},
                              {"P1, conjugate gradients", 1, SolverType::cg},
                              {"P2, direct", 2, SolverType::direct},
                              {"P2, conjugate gradients", 2, SolverType::cg}};

  scene::Scene
  make_scene(const Way &way, const double nu)
  {
    scene::Scene scene;
    scene.materials        = {material("stuff", 20., nu)};
    scene.solver.type      = way.solver;
    scene.solver.tolerance = 1e-13;
    return scene;
  }

  scene::SupportParameters
  sliding(const std::string &name, const std::string &where, const std::string &distance = "0")
  {
    scene::SupportParameters s = support(name, where);
    s.type                     = SupportType::sliding;
    s.normal_displacement      = distance;
    return s;
  }

  scene::SupportParameters
  rigid(const std::string &name, const std::string &where)
  {
    scene::SupportParameters s = support(name, where);
    s.type                     = SupportType::rigid;
    return s;
  }

  /** A solution with what its system refers to. */
  struct Solved : solve::StaticSolution
  {
    Solved(const tetradapt::scene::Scene        &given,
           const std::shared_ptr<mesh::TetMesh> &body,
           const unsigned int                    degree)
      : scene(std::make_unique<tetradapt::scene::Scene>(given))
    {
      auto selected = std::make_shared<mesh::TetMesh>(*body);
      select(*selected, *scene);
      materials = std::make_unique<mechanics::MaterialMap>(*scene, *selected);
      own       = std::make_unique<solve::StaticSystem>(
        *scene, *materials, selected, degree, MPI_COMM_WORLD, core::Log());
      static_cast<solve::StaticSolution &>(*this) = own->solve(nullptr, {});
      whole                                       = fem::replicate(*displacement);
    }

    solve::Equilibrium
    forces() const
    {
      return own->equilibrium(*this, {});
    }

    std::unique_ptr<tetradapt::scene::Scene> scene;
    std::unique_ptr<mechanics::MaterialMap>  materials;
    std::unique_ptr<solve::StaticSystem>     own;
    std::shared_ptr<const mesh::NodalField>  whole; ///< the displacement on every rank
  };

  /** The largest difference of a solution from @p exact, relative to the largest value. */
  double
  difference(const mesh::NodalField &field, const std::function<Vector3(const Point<3> &)> &exact)
  {
    double largest = 0., scale = 0.;
    for (unsigned int node = 0; node < field.values.size(); ++node)
      {
        const Vector3 u = exact(field.node_position(node));
        largest         = std::max(largest, (field.values[node] - u).norm());
        scale           = std::max(scale, u.norm());
      }
    return largest / scale;
  }

  /** The columns are axes along the sides of an inclined block, in no special direction. */
  Tensor<2, 3>
  inclined_axes()
  {
    const Vector3 a = Vector3({0.3, 0.8, -0.5}) / Vector3({0.3, 0.8, -0.5}).norm();
    Vector3       b({0.7, 0.1, 0.9});
    b -= (a * b) * a;
    b /= b.norm();
    const Vector3 c = cross_product_3d(a, b);
    Tensor<2, 3>  axes;
    for (unsigned int d = 0; d < 3; ++d)
      {
        axes[d][0] = a[d];
        axes[d][1] = b[d];
        axes[d][2] = c[d];
      }
    return axes;
  }

  std::string
  text_of(const double value)
  {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
  }

  /** "(a*x + b*y + c*z)" */
  std::string
  along(const Vector3 &a)
  {
    return "((" + text_of(a[0]) + ")*x + (" + text_of(a[1]) + ")*y + (" + text_of(a[2]) + ")*z)";
  }

  /** A block of 2 x 1 x 1.5 along the inclined axes from the origin. */
  std::shared_ptr<mesh::TetMesh>
  inclined_block(const Tensor<2, 3> &axes, const std::array<unsigned int, 3> &n)
  {
    auto body = box(Point<3>(2., 1., 1.5), n);
    for (auto &p : body->points)
      p = Point<3>(axes * Vector3(p));
    return body;
  }

  void
  inclined_blocks(const Way &way)
  {
    if (first_rank)
      std::cout << "Inclined block, " << way.name << '\n';
    const Tensor<2, 3> axes = inclined_axes();
    Vector3            axis[3];
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int d = 0; d < 3; ++d)
        axis[k][d] = axes[d][k];
    const double size[3] = {2., 1., 1.5};
    const auto   body    = inclined_block(axes, {{4, 2, 3}});
    const auto   near    = [&](const unsigned int k, const bool far) {
      return along(axis[k]) + (far ? " > " + text_of(size[k]) + " - 1e-9" : std::string(" < 1e-9"));
    };

    // Pressed on three sides: u = -p (1 - 2 nu) / E x.
    scene::Scene scene = make_scene(way, 0.3);
    scene.supports
      = {sliding("sides", near(0, false) + " || " + near(1, false) + " || " + near(2, false))};
    scene.loads     = {load("pressure",
                        LoadType::pressure,
                        near(0, true) + " || " + near(1, true) + " || " + near(2, true),
                        {{"2", "", ""}})};
    Solved solution = Solved(scene, body, way.degree);
    expect("one support on three sides under pressure",
           difference(*solution.whole,
                      [](const Point<3> &x) { return -2. * 0.4 / 20. * Vector3(x); }),
           1e-10);

    // Moved on all sides: u = A x with principal axes along the sides.
    const double stretch[3] = {0.01, -0.03, 0.02};
    scene.supports.clear();
    scene.loads.clear();
    for (unsigned int k = 0; k < 3; ++k)
      {
        scene.supports.push_back(sliding(std::string("low ") + "abc"[k], near(k, false)));
        scene.supports.push_back(
          sliding(std::string("high ") + "abc"[k],
                  near(k, true),
                  text_of(stretch[k]) + "/" + text_of(size[k]) + "*" + along(axis[k])));
      }
    solution = Solved(scene, body, way.degree);
    expect("moved on six sides",
           difference(*solution.whole,
                      [&](const Point<3> &x) {
                        Vector3 u;
                        for (unsigned int k = 0; k < 3; ++k)
                          u += stretch[k] / size[k] * (axis[k] * Vector3(x)) * axis[k];
                        return u;
                      }),
           1e-10);
    // Reactions are the tractions of that stress, along the normals.
    const auto   forces = solution.forces();
    const double mu = 20. / 2.6, lambda = 20. * 0.3 / (1.3 * 0.4);
    double       wrong = 0.;
    for (unsigned int k = 0; k < 3; ++k)
      {
        double stress = 2. * mu * stretch[k] / size[k];
        for (unsigned int l = 0; l < 3; ++l)
          stress += lambda * stretch[l] / size[l];
        const double area = 3. / size[k];
        wrong
          = std::max(wrong,
                     (forces.supports[2 * k + 1].resultant.force - stress * area * axis[k]).norm());
        wrong = std::max(wrong,
                         (forces.supports[2 * k].resultant.force + stress * area * axis[k]).norm());
      }
    expect("reactions along the normals", wrong, 1e-9);
    expect("balance", forces.relative_imbalance, 1e-9);

    // A side that slides, and meets sides on which Cartesian components are fixed.
    scene.supports = {sliding("side", near(0, false)),
                      support("end", near(1, false), "z", {{"0", "0", "0.01"}}),
                      support("other", near(2, false), "x", {{"0.01", "0", "0"}})};
    scene.loads    = {load("pressure", LoadType::pressure, near(0, true), {{"1 + x", "", ""}})};
    solution       = Solved(scene, body, way.degree);
    const auto &constrained = solution.own->prescribed();
    double      off         = 0.;
    for (unsigned int node = 0; node < solution.whole->values.size(); ++node)
      {
        const Vector3  u = solution.whole->values[node];
        const Point<3> x = solution.whole->node_position(node);
        if (axis[0] * Vector3(x) < 1e-9)
          off = std::max(off, std::abs(axis[0] * u));
        if (axis[1] * Vector3(x) < 1e-9)
          off = std::max(off, std::abs(u[2] - 0.01));
        if (axis[2] * Vector3(x) < 1e-9)
          off = std::max(off, std::abs(u[0] - 0.01));
      }
    expect("a node in three supports is held by all", off, 1e-12);
    expect("some nodes are inclined", !constrained.inclined.empty());
    const auto mixed = solution.forces();
    expect("balance with components", mixed.relative_imbalance, 1e-9);
    expect("reaction along the normal only",
           cross_product_3d(mixed.supports[0].resultant.force, axis[0]).norm()
             / mixed.supports[0].resultant.force.norm(),
           1e-9);
  }

  /** A sliding support on sides along the axes is the same as one of components. */
  void
  aligned_sides(const Way &way)
  {
    if (first_rank)
      std::cout << "Sides along the axes, " << way.name << '\n';
    scene::Scene scene = make_scene(way, 0.3);
    const auto   body  = box(Point<3>(2., 1., 1.), {{4, 3, 3}});
    scene.loads        = {load("end", LoadType::traction, "x > 2 - 1e-9", {{"1", "y", "z*x"}})};
    scene.supports     = {support("a", "x < 1e-9", "x", {{"-0.01*y", "0", "0"}}),
                          support("b", "y < 1e-9", "y"),
                          support("c", "z > 1 - 1e-9", "z", {{"0", "0", "0.02*x"}})};
    const Solved fixed(scene, body, way.degree);
    scene.supports = {sliding("a", "x < 1e-9", "0.01*y"),
                      sliding("b", "y < 1e-9"),
                      sliding("c", "z > 1 - 1e-9", "0.02*x")};
    const Solved slides(scene, body, way.degree);
    double       largest = 0.;
    for (unsigned int i = 0; i < fixed.whole->values.size(); ++i)
      largest = std::max(largest, (fixed.whole->values[i] - slides.whole->values[i]).norm());
    expect("the same as components", largest, 1e-12);
    expect("no node is inclined", slides.own->prescribed().inclined.empty());
  }

  void
  rigid_ends(const Way &way)
  {
    if (first_rank)
      std::cout << "Rigid end, " << way.name << '\n';
    scene::Scene scene = make_scene(way, 0.);
    const auto   body  = box(Point<3>(3., 1., 1.), {{6, 2, 2}});
    scene.supports     = {support("wall", "x < 1e-9"), rigid("plate", "x > 3 - 1e-9")};
    auto &plate        = scene.supports[1].rigid;

    plate.force     = {{"2", "0", "0"}};
    Solved solution = Solved(scene, body, way.degree);
    expect("tension",
           difference(*solution.whole,
                      [](const Point<3> &x) {
                        return Vector3({0.1 * x[0], 0., 0.});
                      }),
           1e-9);
    expect("energy", solution.strain_energy - 0.5 * 2. * 0.3, 1e-9);
    expect("work", solution.external_work - 2. * 0.3, 1e-9);

    if (way.degree == 2)
      {
        // M / (E I) = 0.06 about y and 0.03 about z; the middle of the end is the centroid.
        plate.force  = {{"0", "0", "0"}};
        plate.moment = {{"0", "0.1", "0.05"}};
        solution     = Solved(scene, body, 2);
        expect("bending by a moment",
               difference(*solution.whole,
                          [](const Point<3> &x) {
                            return Vector3({x[0] * (0.06 * (x[2] - 0.5) - 0.03 * (x[1] - 0.5)),
                                            0.015 * x[0] * x[0],
                                            -0.03 * x[0] * x[0]});
                          }),
               1e-8);
        const auto   point     = solution.forces().reference_points[0];
        double       wrong     = 0.;
        const double motion[6] = {0., 0.135, -0.27, 0., 0.18, 0.09};
        for (unsigned int k = 0; k < 6; ++k)
          wrong = std::max(wrong, std::abs(point.motion[k] - motion[k]));
        expect("motion of the reference point", wrong, 1e-8);
      }

    // Loads that cause a motion, and the motion that causes these reactions.
    scene.materials[0].constants["Poisson ratio"] = 0.3;
    plate                                         = {};
    plate.reference_point                         = Point<3>(3.5, 0.2, -0.4);
    plate.force                                   = {{"1", "-0.4", "0.3"}};
    plate.moment                                  = {{"0.2", "0.5", "-0.3"}};
    const Vector3 force({1., -0.4, 0.3}), moment({0.2, 0.5, -0.3});
    const auto    loaded = Solved(scene, body, way.degree);
    const auto    free   = loaded.forces();
    expect("balance", free.relative_imbalance, 1e-9);
    expect("no reaction of what is free",
           free.reference_points[0].reaction.force.norm()
             + free.reference_points[0].reaction.moment.norm(),
           1e-9);
    for (const unsigned int n_prescribed : {1u, 4u, 6u})
      {
        const auto motion = free.reference_points[0].motion;
        plate.force       = {{"1", "-0.4", "0.3"}};
        plate.moment      = {{"0.2", "0.5", "-0.3"}};
        plate.translation = plate.rotation = {};
        for (unsigned int i = 0; i < n_prescribed; ++i)
          {
            const unsigned int k = (5 * i + 1) % 6; // in another order
            (k < 3 ? plate.translation[k] : plate.rotation[k - 3]) = motion[k];
            (k < 3 ? plate.force[k] : plate.moment[k - 3])         = "0";
          }
        const auto moved   = Solved(scene, body, way.degree);
        const auto forces  = moved.forces();
        double     largest = 0., scale = 0.;
        for (unsigned int i = 0; i < moved.whole->values.size(); ++i)
          {
            largest = std::max(largest, (moved.whole->values[i] - loaded.whole->values[i]).norm());
            scale   = std::max(scale, loaded.whole->values[i].norm());
          }
        const std::string text = std::to_string(n_prescribed) + " prescribed: ";
        expect(text + "the same displacement", largest / scale, 1e-9);
        const auto &point = forces.reference_points[0];
        expect(text + "force and reaction are the load",
               (point.force + point.reaction.force - force).norm()
                 + (point.moment + point.reaction.moment - moment).norm(),
               1e-8);
        expect(text + "balance", forces.relative_imbalance, 1e-8);
        expect(text + "the same energy", moved.strain_energy / loaded.strain_energy - 1., 1e-9);
      }

    // Two plates joined by nothing but the body, one of them turned.
    scene.supports = {rigid("foot", "x < 1e-9"), rigid("head", "x > 3 - 1e-9")};
    scene.supports[0].rigid.translation = {{0., 0., 0.}};
    scene.supports[0].rigid.rotation    = {{0., 0., 0.}};
    scene.supports[1].rigid.rotation    = {{0.1, std::nullopt, std::nullopt}};
    scene.loads        = {load("side", LoadType::traction, "z > 1 - 1e-9", {{"0", "0", "-0.1"}})};
    const auto twisted = Solved(scene, body, way.degree);
    expect("a plate turned about its axis balances", twisted.forces().relative_imbalance, 1e-8);
  }

  /** Iterations with the end of a bar rigid or sliding, against the same bar with it fixed. */
  void
  iterations(const Way &way)
  {
    if (way.solver == SolverType::direct)
      return;
    scene::Scene scene      = make_scene(way, 0.3);
    scene.solver.tolerance  = 1e-8;
    const unsigned int n    = way.degree == 1 ? 12 : 6;
    const auto         axes = inclined_axes();
    auto               body = box(Point<3>(4., 1., 1.), {{4 * n, n, n}});
    for (auto &p : body->points)
      p = Point<3>(axes * Vector3(p));
    Vector3 axis;
    for (unsigned int d = 0; d < 3; ++d)
      axis[d] = axes[d][0];
    const std::string x = along(axis);
    scene.loads         = {load("weight", LoadType::body_force, "", {{"0.1", "0.2", "-0.3"}})};
    scene.supports      = {support("wall", x + " < 1e-9"), support("end", x + " > 4 - 1e-9")};
    const auto fixed    = Solved(scene, body, way.degree).iterations;
    scene.supports[1]   = sliding("end", x + " > 4 - 1e-9");
    const auto slides   = Solved(scene, body, way.degree).iterations;
    scene.supports[1]   = rigid("end", x + " > 4 - 1e-9");
    const auto coupled  = Solved(scene, body, way.degree).iterations;
    if (first_rank)
      {
        std::cout << "Iterations, " << way.name << '\n';
        check("  sliding: at most 30 % more than fixed", slides <= 1.3 * fixed);
        check("  rigid: at most 30 % more than fixed", coupled <= 1.3 * fixed);
      }
    if (std::getenv("TETRADAPT_PRINT_ITERATIONS") != nullptr && first_rank)
      std::cerr << way.name << ": fixed " << fixed << ", sliding " << slides << ", rigid "
                << coupled << '\n';
  }

  void
  refusals()
  {
    const auto prescribe = [](const std::vector<scene::SupportParameters> &supports) {
      scene::Scene scene;
      scene.supports = supports;
      auto body      = *box(Point<3>(2., 1., 1.), {{2, 2, 2}}, 0.);
      select(body, scene);
      mechanics::prescribe(supports, body, nullptr);
    };
    scene::SupportParameters plate = rigid("plate", "x > 2 - 1e-9");
    print_refusal("contradiction of sides that slide", [&] {
      prescribe(
        {sliding("low", "z < 1e-9"), sliding("also low", "z < 1e-9 && x > 1 - 1e-9", "0.1")});
    });
    print_refusal("contradiction with a component", [&] {
      prescribe(
        {support("low", "z < 1e-9", "z"), sliding("also low", "z < 1e-9 && x > 1 - 1e-9", "0.1")});
    });
    print_refusal("shared nodes", [&] { prescribe({support("low", "z < 1e-9"), plate}); });
    print_refusal("shared with what slides", [&] {
      prescribe({sliding("low", "z < 1e-9"), plate});
    });
    print_refusal("not held: slides", [&] { prescribe({sliding("low", "z < 1e-9")}); });
    print_refusal("not held: free to turn", [&] {
      plate.rigid.translation = {{0., 0., 0.}};
      plate.rigid.rotation    = {{0., std::nullopt, 0.}};
      prescribe({plate});
    });
    print_refusal("held by two sides that slide and an end", [&] {
      prescribe({sliding("two", "z < 1e-9 || y < 1e-9"), support("end", "x < 1e-9", "x")});
    });
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize init(argc, argv, 1);
  first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  for (const Way &way : ways)
    {
      inclined_blocks(way);
      aligned_sides(way);
      rigid_ends(way);
      iterations(way);
    }
  if (first_rank)
    refusals();
}
