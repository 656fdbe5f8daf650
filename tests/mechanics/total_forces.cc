// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Total forces and moments are those that the scene gives, on straight and projected meshes, as is
// the centrifugal force of bodies that turn; on any number of ranks.

#include "tetradapt/fem/triangulation.h"
#include "tetradapt/mechanics/loads.h"
#include "tetradapt/mechanics/surface_loads.h"
#include "tetradapt/mesh/boundary_projection.h"

#include "bodies.h"

#include <deal.II/base/mpi.h>

using namespace bodies;
using scene::LoadType;

namespace
{
  bool         first_rank = true;
  unsigned int degree     = 1;

  scene::LoadParameters
  total(const std::string      &where,
        const Texts            &force,
        const Texts            &moment = {{"0", "0", "0"}},
        std::optional<Point<3>> about  = std::nullopt)
  {
    auto result         = load("l", LoadType::total_force, where, force);
    result.total.moment = moment;
    result.total.about  = about;
    return result;
  }

  scene::LoadParameters
  bearing(const std::string &where, const Texts &force)
  {
    auto result               = total(where, force);
    result.total.distribution = scene::Distribution::bearing;
    return result;
  }

  scene::Scene
  scene_with(const scene::LoadParameters &load)
  {
    scene::Scene scene;
    scene.materials            = {material("left", 10., 0.2), material("right", 20., 0.3)};
    scene.materials[1].regions = {1};
    scene.materials[0].density = 3.;
    scene.materials[1].density = 5.;
    scene.loads                = {load};
    return scene;
  }

  /** A quarter of a tube between the radii 1 and 2, of length 1, whose walls are known. */
  std::shared_ptr<mesh::TetMesh>
  tube(scene::Scene &scene, const std::array<unsigned int, 3> &n)
  {
    const auto body = box(Point<3>(1., 0.5 * std::acos(-1.), 1.), n, 0.15);
    for (auto &p : body->points)
      p = Point<3>((1. + p[0]) * std::cos(p[1]), (1. + p[0]) * std::sin(p[1]), p[2]);
    std::fill(body->regions.begin(), body->regions.end(), 1);
    mesh::finalize(*body, "tube");
    scene.materials[1].regions.clear();
    scene.materials.erase(scene.materials.begin());
    scene.mesh.projection           = scene::MeshParameters::Projection::expression;
    scene.mesh.projection_functions = {"x^2 + y^2 - 1", "x^2 + y^2 - 4"};
    mesh::make_projection(scene)->assign(*body);
    return body;
  }

  mechanics::LoadTotal
  total_on(const std::shared_ptr<mesh::TetMesh> &body, const scene::Scene &scene)
  {
    select(*body, scene);
    const mechanics::MaterialMap materials(scene, *body);
    const auto triangulation = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
    const fem::Space space(triangulation, degree);
    return mechanics::assemble_loads(scene, materials, space).totals.at(0);
  }

  void
  report(const std::string  &what,
         const Tensor<1, 3> &value,
         const Tensor<1, 3> &exact,
         const double        tolerance = 1e-12)
  {
    if (first_rank)
      check("  " + what, (value - exact).norm(), 0., std::max(1., exact.norm()), tolerance);
  }

  mechanics::LoadTotal
  on_box(const scene::LoadParameters &load)
  {
    return total_on(box(Point<3>(2, 1, 1), {{4, 3, 2}}, 0.2, 1.), scene_with(load));
  }

  mechanics::LoadTotal
  on_tube(const scene::LoadParameters &load, const unsigned int n)
  {
    auto       scene = scene_with(load);
    const auto body  = tube(scene, {{n, 2 * n, n}});
    return total_on(body, scene);
  }

  /** The same load on a wall of the tube. */
  scene::LoadParameters
  on_wall(scene::LoadParameters load, const bool is_outer)
  {
    load.selector.where  = "";
    load.selector.groups = {is_outer ? "x-max" : "x-min"};
    return load;
  }

  void
  even()
  {
    const std::string end = "x > 2-1e-9";
    auto              t   = on_box(total(end, {{"1", "-2", "3"}}));
    report("force", t.resultant.force, Tensor<1, 3>({1., -2., 3.}));
    report("moment about the centroid",
           t.resultant.moment_about(Point<3>(2., .5, .5)),
           Tensor<1, 3>());
    t = on_box(total(
      end + " || y > 1-1e-9", {{"1", "-2", "3"}}, {{"0.5", "7", "2*3"}}, Point<3>(-1., 4., 2.)));
    report("force on two sides", t.resultant.force, Tensor<1, 3>({1., -2., 3.}));
    report("moment about a point",
           t.resultant.moment_about(Point<3>(-1., 4., 2.)),
           Tensor<1, 3>({.5, 7., 6.}));
    t = on_box(total(end, {{"0", "0", "0"}}, {{"1", "0", "0"}}));
    report("no force but a moment", t.resultant.force, Tensor<1, 3>());
    report("twist", t.resultant.moment, Tensor<1, 3>({1., 0., 0.}));
    for (const unsigned int n : {1, 3})
      {
        t = on_tube(on_wall(total("", {{"1", "-2", "3"}}, {{"4", "5", "-6"}}, Point<3>(.5, .5, 3.)),
                            true),
                    n);
        report("force on a curved wall", t.resultant.force, Tensor<1, 3>({1., -2., 3.}));
        report("moment about a point",
               t.resultant.moment_about(Point<3>(.5, .5, 3.)),
               Tensor<1, 3>({4., 5., -6.}));
      }
  }

  /** Tractions on the end of a box against the formulas for a square of side 1. */
  void
  values()
  {
    if (!first_rank)
      return;
    const auto body = box(Point<3>(2, 1, 1), {{4, 3, 2}}, 0.2, 1.);
    const auto look = [&](const scene::LoadParameters &load, const Point<3> &point) {
      auto scene = scene_with(load);
      select(*body, scene);
      const mechanics::SurfaceLoads loads(scene, *body);
      unsigned int                  face = 0;
      while (loads.on_face(face).empty())
        ++face;
      return loads.traction(0, face, point, Tensor<1, 3>({1., 0., 0.}));
    };
    // An end of area 1 with second moments 1/12: force over area and moment times distance
    // over second moment.
    report("bending stress",
           look(total("x > 2-1e-9", {{"2", "0", "0"}}, {{"0", "3", "0"}}), Point<3>(2., .25, .75)),
           Tensor<1, 3>({2. + 3. * .25 * 12., 0., 0.}));
    report("twisting stress",
           look(total("x > 2-1e-9", {{"0", "0", "0"}}, {{"3", "0", "0"}}), Point<3>(2., .25, .75)),
           Tensor<1, 3>({0., -3. * .25 * 6., 3. * -.25 * 6.}));
  }

  void
  bearings()
  {
    // Two sides whose normals are at 45 degrees to the force.
    auto t = on_box(bearing("y > 1-1e-9 || z > 1-1e-9", {{"0", "-1", "-1"}}));
    report("force on a wedge", t.resultant.force, Tensor<1, 3>({0., -1., -1.}));
    report("its moment", t.resultant.moment, Tensor<1, 3>({0., 1., -1.}));
    if (first_rank)
      check("  nothing added", t.note.empty());
    const double pi = std::acos(-1.);
    for (const unsigned int n : {2, 6})
      {
        t = on_tube(on_wall(bearing("", {{"1", "1", "0"}}), false), n);
        report("pin in a hole", t.resultant.force, Tensor<1, 3>({1., 1., 0.}));
        t = on_tube(on_wall(bearing("", {{"2", "0", "0"}}), false), n);
        report("along x", t.resultant.force, Tensor<1, 3>({2., 0., 0.}));
        // int cos sin / int cos^2 over a quarter: 2 / pi = 64 %.
        if (first_rank)
          check("  told what is added",
                t.note.find(" 64 % of the force") != std::string::npos || n == 2);
        t = on_tube(on_wall(bearing("", {{"0", "-3", "0"}}), true), n);
        report("bearing on a shaft", t.resultant.force, Tensor<1, 3>({0., -3., 0.}));
      }
    if (!first_rank)
      return;
    // The whole pressure is k cos; int cos^2 = pi/4 over a quarter of radius 1.
    auto       scene = scene_with(on_wall(bearing("", {{"2", "0", "0"}}), false));
    const auto body  = tube(scene, {{6, 12, 6}});
    select(*body, scene);
    const mechanics::SurfaceLoads loads(scene, *body);
    const double                  k = 2. / (pi / 4.), across = -k / (pi / 2.) * .5;
    const double                  angle = .3;
    const Tensor<1, 3>            n({-std::cos(angle), -std::sin(angle), 0.});
    const auto                    traction
      = loads.surface_traction(0, {Point<3>(std::cos(angle), std::sin(angle), .5), n});
    report("pressure of the pin",
           traction,
           -k * std::cos(angle) * n + Tensor<1, 3>({0., across, 0.}),
           1e-2);
  }

  /** int over a box of x x (A x - b) for a symmetric A. */
  void
  add_moment(const Point<3>       &lower,
             const Point<3>       &upper,
             const Tensor<2, 3>   &A,
             const Tensor<1, 3>   &b,
             const double          density,
             mechanics::Resultant &sum)
  {
    double       volume = density;
    Tensor<1, 3> centre;
    Tensor<2, 3> squares;
    for (unsigned int d = 0; d < 3; ++d)
      {
        volume *= upper[d] - lower[d];
        centre[d] = .5 * (lower[d] + upper[d]);
      }
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int l = 0; l < 3; ++l)
        squares[j][l]
          = volume
            * (centre[j] * centre[l] + (j == l ? std::pow(upper[j] - lower[j], 2) / 12. : 0.));
    sum.force += volume * (A * centre - b);
    sum.moment -= volume * cross_product_3d(centre, b);
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
        for (unsigned int l = 0; l < 3; ++l)
          sum.moment[i] += A[k][l] * squares[j][l] - A[j][l] * squares[k][l];
      }
  }

  void
  rotation()
  {
    auto turning                      = load("l", LoadType::rotation, "", {{"0", "0", "0"}});
    turning.rotation.axis_point       = Point<3>(.3, -.2, .1);
    turning.rotation.axis             = Point<3>(2., 4., 4.);
    turning.rotation.angular_velocity = -1.7;
    const auto         t              = on_box(turning);
    const Tensor<1, 3> e({1. / 3., 2. / 3., 2. / 3.});
    Tensor<2, 3>       A = -outer_product(e, e);
    for (unsigned int d = 0; d < 3; ++d)
      A[d][d] += 1.;
    A *= 1.7 * 1.7;
    const Tensor<1, 3>   b = A * Tensor<1, 3>(turning.rotation.axis_point);
    mechanics::Resultant exact;
    add_moment(Point<3>(0., 0., 0.), Point<3>(1., 1., 1.), A, b, 3., exact);
    add_moment(Point<3>(1., 0., 0.), Point<3>(2., 1., 1.), A, b, 5., exact);
    report("rotation", t.resultant.force, exact.force);
    report("its moment", t.resultant.moment, exact.moment);
  }

  void
  refusals()
  {
    const auto make = [](const std::shared_ptr<mesh::TetMesh> &body, scene::Scene scene) {
      select(*body, scene);
      mechanics::SurfaceLoads(scene, *body).check();
    };
    print_refusal("a pin that pulls", [&] {
      auto       scene = scene_with(on_wall(bearing("", {{"-1", "-1", "0"}}), false));
      const auto body  = tube(scene, {{1, 2, 1}});
      make(body, scene);
    });
    print_refusal("a pin that slides", [&] {
      make(box(Point<3>(2, 1, 1), {{2, 1, 1}}),
           scene_with(bearing("x > 2-1e-9", {{"0", "1", "0"}})));
    });
    print_refusal("twist of a line", [&] {
      make(box(Point<3>(2, 1, 1e-6), {{2, 1, 1}}),
           scene_with(total("x > 2-1e-9", {{"0", "0", "1"}}, {{"0", "1", "0"}})));
    });
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  for (degree = 1; degree <= 2; ++degree)
    {
      if (first_rank)
        std::cout << "degree " << degree << '\n';
      even();
      bearings();
      rotation();
    }
  values();
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    refusals();
}
