// SPDX-License-Identifier: AGPL-3.0-or-later
// What errors leave out: which cells, what density the cells inside get for the refinement, and
// that differences and the norms that they are relative to have it on neither side.

#include "tetradapt/compare/excluded_region.h"

#include "tetradapt/compare/difference.h"
#include "tetradapt/core/exceptions.h"

#include "test_meshes.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>

using namespace tetradapt;
using namespace test_meshes;

void
check(const std::string &what, const bool holds)
{
  std::cout << what << ": " << (holds ? "yes" : "NO") << std::endl;
}

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  auto mesh  = cube(4, [](const Point<3> &p) { return Point<3>(2. * p[0], p[1], p[2]); });
  mesh->kept = {{"Loads/tip", {{2., .5, 1.}}},
                {"Supports/hinge", {{0., 0., 0.}, {0., 1., 0.}}},
                {"Supports/foot", {{1., 0., 0.}}}};
  scene::Scene scene;
  scene.supports.resize(2);
  scene.supports[0].name                  = "hinge";
  scene.supports[0].place.line            = {{0., 0., 0.}, {0., 1., 0.}};
  scene.supports[0].place.excluded_radius = .3;
  scene.supports[1].name                  = "foot";
  scene.supports[1].place.point           = Point<3>(1., 0., 0.);
  scene.supports[1].place.excluded_radius = 0.;
  scene.loads.resize(1);
  scene.loads[0].name        = "tip";
  scene.loads[0].type        = scene::LoadType::point_force;
  scene.loads[0].place.point = Point<3>(2., .5, 1.);

  const compare::ExcludedRegion none;
  check("nothing is empty", none.empty() && !none.contains(Point<3>()));
  const compare::ExcludedRegion region(scene, *mesh);
  for (const auto &part : region.all_parts())
    std::cout << part.name << (part.radius > 0. ? ": " + part.text() : ": nothing") << std::endl;
  check("inside the default ball", region.contains({1.95, .5, .93}));
  check("outside of it", !region.contains({1.92, .5, .93}));
  check("in the tube", region.contains({.2, .9, .2}) && !region.contains({.25, .5, .2}));
  check("in its round end", region.contains({.1, 1.2, .1}) && !region.contains({.1, 1.3, .1}));
  check("a radius of 0 leaves out nothing", !region.contains({1., 0., 0.}));

  // The tip's ball is smaller than the cells, the tube is not.
  const auto   cells = region.cells(*mesh);
  unsigned int n     = 0;
  bool         right = true;
  for (unsigned int c = 0; c < mesh->n_cells(); ++c)
    {
      Point<3> middle;
      for (const unsigned int v : mesh->cells[c])
        middle += mesh->points[v] / 4.;
      n += cells[c] ? 1 : 0;
      right = right && cells[c] == (std::hypot(middle[0], middle[2]) < .3);
    }
  check("cells by their centroids", right && n > 0);
  std::vector<double> indicators(mesh->n_cells());
  for (unsigned int c = 0; c < mesh->n_cells(); ++c)
    indicators[c] = cells[c] ? 1e9 : 3. * std::sqrt(mesh::cell_volume(*mesh, c));
  auto cleared = indicators;
  region.clear(*mesh, cleared);
  region.continue_into(*mesh, indicators);
  bool zero = true, continued = true;
  for (unsigned int c = 0; c < mesh->n_cells(); ++c)
    {
      zero      = zero && (cells[c] ? cleared[c] == 0. : cleared[c] == indicators[c]);
      continued = continued
                  && std::abs(indicators[c] - 3. * std::sqrt(mesh::cell_volume(*mesh, c))) < 1e-12;
    }
  check("estimates are zero inside", zero);
  check("indicators for refinement have the density around it", continued);

  // u = (x, 0, 0) where x > 1, compared with zero in all cells: half of it lies in a large ball.
  scene.materials.resize(1);
  const mechanics::MaterialMap   materials(scene, *mesh);
  scene::ExactSolutionParameters exact;
  exact.displacement = {{"x", "0", "0"}};
  scene.loads.clear();
  scene.supports.resize(1);
  scene.supports[0].place.excluded_radius = 1.2;
  const compare::ExcludedRegion large(scene, *mesh);
  const auto                    left_out = large.cells(*mesh);
  double                        volume   = 0.;
  for (unsigned int c = 0; c < mesh->n_cells(); ++c)
    volume += left_out[c] ? 0. : mesh::cell_volume(*mesh, c);
  const mesh::NodalField u_h(mesh, 1);
  const auto to_exact = compare::difference_to_exact(u_h, exact, materials, MPI_COMM_WORLD, large);
  check("difference to the exact solution",
        std::abs(to_exact.h1 - std::sqrt(volume)) < 1e-6
          && std::abs(to_exact.h1_norm - to_exact.h1) < 1e-6);
  auto other = std::make_shared<mesh::NodalField>(mesh, 1);
  for (unsigned int node = 0; node < other->n_nodes(); ++node)
    other->values[node][0] = mesh->points[node][0];
  const compare::ReferenceSampling sampling(other, materials, MPI_COMM_WORLD, large);
  const compare::PointLocator      locator(mesh);
  const auto to_reference = compare::difference_to_reference(u_h, locator, sampling);
  check("difference to a reference",
        std::abs(to_reference.h1 - std::sqrt(volume)) < 1e-12
          && std::abs(to_reference.h1_norm - to_reference.h1) < 1e-12
          && std::abs(to_reference.energy - to_reference.energy_norm) < 1e-12);
  bool quiet = true;
  for (unsigned int c = 0; c < mesh->n_cells(); ++c)
    quiet = quiet && (to_reference.cell_energy[c] == 0.) == left_out[c]
            && (to_exact.cell_energy[c] == 0.) == left_out[c];
  check("cells are zero where they are left out", quiet);
  const auto ren = compare::nodal_ren(u_h, exact, MPI_COMM_WORLD, large);
  check("REN is 1 outside and counts no node inside",
        std::abs(ren.mean - 1.) < 1e-12 && std::abs(ren.max - 1.) < 1e-12);

  scene.supports[0].place.excluded_radius = 10.;
  try
    {
      compare::ExcludedRegion(scene, *mesh).cells(*mesh);
      check("everything left out is refused", false);
    }
  catch (const core::InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}
