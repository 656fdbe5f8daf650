// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The totals of loads whose values vary, on meshes from coarse to fine, against exact integrals:
// 1e-6 for smooth ones, 1e-4 for jumps on faces, 1e-3 for jumps in cells, on every mesh. In
// Release only: millions of values take minutes in Debug.

#include "tetradapt/fem/triangulation.h"
#include "tetradapt/mechanics/loads.h"

#include "bodies.h"

#include <deal.II/base/mpi.h>

using namespace bodies;
using scene::LoadType;

namespace
{
  const double pi = std::acos(-1.);

  struct Case
  {
    std::string           what;
    scene::LoadParameters load;
    double                force; ///< in z
    double                tolerance;
    bool                  is_converged; ///< quadrature says so
  };

  scene::LoadParameters
  fine(scene::LoadParameters load, const double size)
  {
    load.smallest_feature = size;
    return load;
  }

  mechanics::LoadTotal
  total_of(const scene::LoadParameters &load, const unsigned int n, const unsigned int degree)
  {
    scene::Scene scene;
    scene.materials                      = {material("m", 10., 0.25)};
    scene.materials[0].density           = 2.;
    scene.materials[0].thermal_expansion = 0.1;
    scene.loads                          = {load};
    const auto body                      = box(Point<3>(1, 1, 1), {{n, n, n}});
    select(*body, scene);
    const mechanics::MaterialMap materials(scene, *body);
    const auto triangulation = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
    const fem::Space space(triangulation, degree);
    auto             loads = mechanics::assemble_loads(scene, materials, space);
    if (load.type != LoadType::temperature)
      return loads.totals[0];
    // A temperature's forces do the work C : alpha int T on a strain: in z, E / (1 - 2 nu).
    double work = 0.;
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      work += loads.forces.local_element(3 * node + 2) * space.node_position(node)[2];
    loads.totals[0].resultant.force[2] = dealii::Utilities::MPI::sum(work, MPI_COMM_WORLD) / 20.;
    return loads.totals[0];
  }

  /** int sin(3 x + y) exp(y) over the unit square. */
  double
  face_waves()
  {
    const auto integral = [](double y) {
      return std::exp(y) / 6. * (std::sin(y) + std::cos(y) - std::cos(3. + y) - std::sin(3. + y));
    };
    return integral(1.) - integral(0.);
  }

  /** int_0^1 (1 - (x - 0.4)^2)^512 dx / 2, by Simpson's rule. */
  double
  high_power()
  {
    double             sum = 0.;
    const unsigned int n   = 20000;
    for (unsigned int i = 0; i <= n; ++i)
      {
        const double x = double(i) / n - 0.4;
        sum += (i == 0 || i == n ? 1. : i % 2 == 1 ? 4. : 2.) * std::pow(1. - x * x, 512.);
      }
    return sum / (6. * n);
  }

  std::vector<Case>
  cases()
  {
    const std::string top    = "z > 1-1e-9";
    const auto        on_top = [&](const std::string &value) {
      return load("t", LoadType::traction, top, {{"0", "0", value}});
    };
    const auto inside = [&](const std::string &value) {
      return load("b", LoadType::body_force, "", {{"0", "0", value}});
    };
    const double bump = std::pow(std::sqrt(pi / 500.), 2), ball = std::pow(pi / 300., 1.5);
    return {
      {"waves on a face", on_top("sin(3*x+y)*exp(y)"), face_waves(), 1e-6, true},
      {"a peak on a face", on_top("exp(-500*((x-.43)^2+(y-.57)^2))"), bump, 1e-6, true},
      {"a small peak, looked for",
       fine(on_top("exp(-5e5*((x-.43)^2+(y-.57)^2))"), 1e-3),
       1e-3 * bump,
       1e-6,
       true},
      {"a square on a face", on_top("if(abs(x-.4)<.13 && abs(y-.5)<.21, 3, 0)"), .3276, 1e-4, true},
      {"a half plane", on_top("if(x + 2*y < 1.1, 1, 0)"), .3, 1e-4, true},
      {"a disc", on_top("if((x-.45)^2+(y-.5)^2 < .3^2, 1, 0)"), .09 * pi, 1e-4, true},
      {"a roof",
       on_top("abs(x-.37)+abs(y-.61)"),
       .37 * .37 / 2 + .63 * .63 / 2 + .61 * .61 / 2 + .39 * .39 / 2,
       1e-5,
       true},
      {"a root at a corner",
       on_top("sqrt(x^2+y^2)"),
       (std::sqrt(2.) + std::log(1. + std::sqrt(2.))) / 3.,
       1e-5,
       true},
      {"pressure",
       load("p", LoadType::pressure, top, {{"if(x<.3, 2, -1)", "", ""}}),
       .1,
       1e-4,
       true},
      {"waves in cells",
       inside("sin(3*x+y)*exp(z)"),
       (std::sin(1.) + std::sin(3.) - std::sin(4.)) / 3. * (std::exp(1.) - 1.),
       1e-6,
       true},
      {"a peak in cells", inside("exp(-300*((x-.43)^2+(y-.57)^2+(z-.5)^2))"), ball, 1e-6, true},
      {"weight, waves",
       load("g", LoadType::gravity, "", {{"0", "0", "cos(2*x)"}}),
       std::sin(2.),
       1e-6,
       true},
      {"a slab in cells", inside("if(x<.37, 1, 0)"), .37, 1e-3, false},
      {"a ball in cells",
       inside("if((x-.5)^2+(y-.5)^2+(z-.5)^2<.4^2, 1, 0)"),
       4. / 3. * pi * .064,
       1e-3,
       false},
      {"a high power", on_top("(((1 - (x-.4)^2)^8)^8)^8*y"), high_power(), 1e-6, true},
      {"with a normal", on_top("nz*x^8"), 1. / 9., 1e-6, true},
      {"heat, waves",
       load("T", LoadType::temperature, "", {{"exp(x)", "", ""}}),
       .1 * (std::exp(1.) - 1.),
       1e-6,
       true},
      {"heat, a slab",
       load("T", LoadType::temperature, "", {{"if(z>.61, 1, 0)", "", ""}}),
       .039,
       1e-3,
       false},
    };
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  const std::vector<unsigned int> meshes{1, 2, 5, 8};
  for (const Case &c : cases())
    {
      double      worst     = 0.;
      bool        converged = true, covered = true;
      std::string degrees;
      for (const unsigned int n : meshes)
        for (const unsigned int degree : {1, 2})
          {
            const auto   total = total_of(c.load, n, degree);
            const double error = std::abs(total.resultant.force[2] - c.force);
            worst              = std::max(worst, error / c.force);
            converged          = converged && total.is_converged();
            // The remainder is an estimate: of the right order. Kinks are not in it, nor what
            // curves and corners leave of parts that were divided along a line.
            const double small = c.tolerance == 1e-4 ? 5e-5 : 1e-6;
            covered            = covered && error <= 10. * total.remainder + small * c.force;
          }
      if (!first_rank)
        continue;
      if (std::getenv("SHOW") != nullptr)
        std::cerr << c.what << ' ' << worst << '\n';
      check(c.what, worst, 0., 1., c.tolerance);
      check("  converged as expected", converged == c.is_converged);
      if (c.tolerance != 1e-5)
        check("  the remainder covers it", covered);
    }
}
