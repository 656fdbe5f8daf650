// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Consistent nodal forces: their sum and moment are those of the load, on any
// number of ranks.

#include "tetradapt/mechanics/loads.h"
#include "tetradapt/fem/replication.h"
#include "tetradapt/fem/triangulation.h"

#include "bodies.h"

#include <deal.II/base/mpi.h>

using namespace bodies;
using scene::LoadType;

namespace
{
  using Forces = std::vector<Tensor<1, 3>>;

  bool first_rank = true;

  void
  report(const std::string  &what,
         const Tensor<1, 3> &value,
         const Tensor<1, 3> &exact,
         double              scale)
  {
    if (first_rank)
      check("  " + what, (value - exact).norm(), 0., scale, 1e-13);
  }

  /** Nodal forces of a scene, those of all ranks together. */
  class Loaded
  {
  public:
    Loaded(const std::shared_ptr<mesh::TetMesh> &body,
           const scene::Scene                   &scene,
           const unsigned int                    degree)
      : field(body, degree)
    {
      select(*body, scene);
      const mechanics::MaterialMap materials(scene, *body);
      const auto triangulation = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
      const fem::Space            space(triangulation, degree);
      const mechanics::NodalLoads loads = mechanics::assemble_loads(scene, materials, space);
      forces                            = fem::replicate(space, loads.forces);
      const mechanics::LoadTotal &total = loads.totals.at(0);
      // Temperatures have no resultant.
      if (scene.loads[0].type != LoadType::temperature && first_rank
          && !((total.resultant.force - sum()).norm() <= 1e-12 * (1. + sum().norm())
               && (total.resultant.moment - moment()).norm() <= 1e-12 * (1. + moment().norm())))
        std::cout << "  WRONG resultant " << total.resultant.force << '\n';
    }

    Tensor<1, 3>
    sum() const
    {
      Tensor<1, 3> sum;
      for (const auto &force : forces)
        sum += force;
      return sum;
    }
    /** About the origin. */
    Tensor<1, 3>
    moment() const
    {
      Tensor<1, 3> sum;
      for (unsigned int node = 0; node < forces.size(); ++node)
        sum += cross_product_3d(Tensor<1, 3>(field.node_position(node)), forces[node]);
      return sum;
    }

    mesh::NodalField field;
    Forces           forces;
  };

  Loaded
  loaded(const scene::LoadParameters &load, const unsigned int degree)
  {
    scene::Scene scene;
    scene.materials            = {material("left", 10., 0.2), material("right", 20., 0.3)};
    scene.materials[1].regions = {1};
    scene.materials[0].density = 3.;
    scene.materials[1].density = 5.;
    scene.materials[0].thermal_expansion = scene.materials[1].thermal_expansion = 0.01;
    scene.loads                                                                 = {load};
    return Loaded(box(Point<3>(2, 1, 1), {{4, 3, 2}}, 0.2, 1.), scene, degree);
  }

  void
  on_faces(const unsigned int degree)
  {
    const auto even
      = loaded(load("t", LoadType::traction, "x > 2-1e-9", {{"1", "-2", "3"}}), degree);
    report("traction", even.sum(), Tensor<1, 3>({1., -2., 3.}), 1.);
    // (2, 1/2, 1/2) x (1, -2, 3)
    report("its moment", even.moment(), Tensor<1, 3>({2.5, -5.5, -4.5}), 1.);

    // On the side z = 1: int x y = 2 * 1/2, int x^2 y = 8/3 * 1/2, int x y^2 = 2 * 1/3.
    const auto uneven
      = loaded(load("t", LoadType::traction, "z > 1-1e-9", {{"0", "0", "x*y"}}), degree);
    report("uneven traction", uneven.sum(), Tensor<1, 3>({0., 0., 1.}), 1.);
    report("its moment", uneven.moment(), Tensor<1, 3>({2. / 3., -4. / 3., 0.}), 1.);

    const auto side = loaded(load("p", LoadType::pressure, "y > 1-1e-9", {{"7", "", ""}}), degree);
    report("pressure on a side", side.sum(), Tensor<1, 3>({0., -14., 0.}), 14.);
    const auto closed = loaded(load("p", LoadType::pressure, "", {{"7", "", ""}}), degree);
    report("pressure all around", closed.sum(), Tensor<1, 3>(), 14.);
    report("its moment", closed.moment(), Tensor<1, 3>(), 14.);
    // Archimedes: the weight of 2 volumes of water, in their centre.
    const auto water = loaded(load("p", LoadType::pressure, "", {{"9 - z", "", ""}}), degree);
    report("buoyancy", water.sum(), Tensor<1, 3>({0., 0., 2.}), 2.);
    report("its moment", water.moment(), Tensor<1, 3>({1., -2., 0.}), 2.);
  }

  /** The side x = 2 of 4 x 3 x 2 bricks has 4 x 3 points, the side z = 1 has 5 x 4, and
   * 4 are on both: each gets the force once, and middles of edges none. */
  void
  on_points(const unsigned int degree)
  {
    const auto side
      = loaded(load("n", LoadType::nodal_force, "x > 2-1e-9", {{"1", "-2", "3"}}), degree);
    report("nodal forces", side.sum(), Tensor<1, 3>({12., -24., 36.}), 36.);
    const auto two
      = loaded(load("n", LoadType::nodal_force, "x > 2-1e-9 || z > 1-1e-9", {{"1", "0", "2+x*y"}}),
               degree);
    report("on two sides", Tensor<1, 3>({two.sum()[0], 0., 0.}), Tensor<1, 3>({28., 0., 0.}), 28.);
    double difference = 0.;
    for (unsigned int node = 0; node < two.forces.size(); ++node)
      {
        const auto   p     = two.field.node_position(node);
        const bool   point = node < two.field.mesh().n_points();
        const double force
          = point && (p[0] > 2. - 1e-9 || p[2] > 1. - 1e-9) ? 2. + p[0] * p[1] : 0.;
        difference = std::max(difference, std::abs(two.forces[node][2] - force));
      }
    if (first_rank)
      check("  each of them", difference, 0., 1., 1e-13);
  }

  void
  on_volumes(const unsigned int degree)
  {
    const auto weight = loaded(load("g", LoadType::gravity, "", {{"0", "0", "-10"}}), degree);
    report("weight", weight.sum(), Tensor<1, 3>({0., 0., -80.}), 80.);
    // Densities 3 at x = 1/2 and 5 at x = 3/2.
    report("its moment", weight.moment(), Tensor<1, 3>({-40., 90., 0.}), 80.);
    auto half         = load("b", LoadType::body_force, "", {{"1", "0", "x*z"}});
    half.selector.ids = {1};
    const auto body   = loaded(half, degree);
    // int_1^2 x dx int z dz = 3/2 * 1/2; int x^2 = 7/3, int z = 1/2, int y x z = 3/8.
    report("body force on a region", body.sum(), Tensor<1, 3>({1., 0., 0.75}), 1.);
    report("its moment", body.moment(), Tensor<1, 3>({0.375, 0.5 - 7. / 6., -0.5}), 1.);

    // Heat pulls evenly in all directions; in the displacement x it does the work
    // int alpha T E / (1 - 2 nu) tr(grad x), T = 2 + x.
    const auto heat = loaded(load("T", LoadType::temperature, "", {{"2 + x", "", ""}}), degree);
    report("heat", heat.sum(), Tensor<1, 3>(), 1.);
    report("its moment", heat.moment(), Tensor<1, 3>(), 1.);
    double work = 0.;
    for (unsigned int node = 0; node < heat.forces.size(); ++node)
      work += heat.forces[node] * heat.field.node_position(node);
    const double exact = 3. * 0.01 * (10. / 0.6 * 2.5 + 20. / 0.4 * 3.5);
    if (first_rank)
      check("  its work", work, exact, exact, 1e-13);
  }

  /** One tetrahedron of volume 1/6: the shares of its nodes. */
  void
  shares(const unsigned int degree)
  {
    const auto make = [] {
      auto body    = std::make_shared<mesh::TetMesh>();
      body->points = {Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(0, 1, 0), Point<3>(0, 0, 1)};
      body->cells  = {{{0, 1, 2, 3}}};
      mesh::finalize(*body, "tetrahedron");
      return body;
    };
    const auto print = [&](const std::string &what, const scene::LoadParameters &load) {
      scene::Scene scene;
      scene.materials            = {material("m", 1., 0.)};
      scene.materials[0].density = 1.;
      scene.loads                = {load};
      const Loaded result(make(), scene, degree);
      if (first_rank)
        {
          std::cout << "  " << what << ":";
          for (const auto &force : result.forces)
            std::cout << ' ' << (std::abs(force[2]) < 1e-14 ? 0. : force[2]);
          std::cout << '\n';
        }
    };
    // Linear: 1/4 each. Quadratic: -1/20 of the whole a vertex, 1/5 an edge.
    print("shares of a weight of 120", load("g", LoadType::gravity, "", {{"0", "0", "720"}}));
    // Linear: 1/3 each. Quadratic: nothing for the vertices, 1/3 an edge.
    print("shares of a traction of 3",
          load("t", LoadType::traction, "z < 1e-9", {{"0", "0", "6"}}));
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  for (const unsigned int degree : {1, 2})
    {
      if (first_rank)
        std::cout << "degree " << degree << '\n';
      on_faces(degree);
      on_points(degree);
      on_volumes(degree);
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
        shares(degree);
    }
}
