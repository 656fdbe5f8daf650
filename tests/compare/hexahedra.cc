// SPDX-License-Identifier: AGPL-3.0-or-later

// A reference on hexahedra: points are found, differences and nodal errors are those to
// the exact solution, and the cache gives back what was put in; on one and two ranks.

#include "tetradapt/compare/difference.h"
#include "tetradapt/compare/reference.h"
#include "tetradapt/compare/reference_key.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/io/mesh_source.h"

#include "test_meshes.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <iostream>

using namespace test_meshes;
using namespace tetradapt::compare;
using mesh::HexahedralField;

namespace
{
  bool first_rank = true;

  void
  check(const std::string &what, const bool holds)
  {
    if (first_rank)
      std::cout << what << ": " << (holds ? "yes" : "NO") << std::endl;
  }

  bool
  near(const double a, const double b, const double tolerance = 1e-12)
  {
    return std::abs(a - b) <= tolerance * std::abs(b);
  }

  Tensor<1, 3>
  quadratic(const Point<3> &p)
  {
    return Tensor<1, 3>({p[0] * p[1] + 0.3, p[1] * p[1] - 0.5 * p[2], p[0] * p[2] + p[2] * p[2]});
  }

  /** Cuts every cell within @p radius of the origin into eight. */
  void
  cut(std::vector<HexahedralField::Cell> &cells, const double radius)
  {
    std::vector<HexahedralField::Cell> result;
    for (const auto &cell : cells)
      if (cell.lower.norm() > radius)
        result.push_back(cell);
      else
        for (unsigned int v = 0; v < 8; ++v)
          {
            HexahedralField::Cell child = cell;
            for (unsigned int d = 0; d < 3; ++d)
              {
                child.size[d] *= .5;
                child.lower[d] += (v >> d & 1) * child.size[d];
              }
            result.push_back(child);
          }
    cells = result;
  }

  /** The quadratic field on the unit cube, with cells of four sizes. */
  std::shared_ptr<HexahedralField>
  field(const unsigned int degree)
  {
    const std::array<std::vector<double>, 3> planes{{{0., .4, 1.}, {0., 1.}, {0., .5, 1.}}};
    std::vector<HexahedralField::Cell>       cells;
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int i = 0; i < 2; ++i)
        {
          HexahedralField::Cell cell;
          cell.lower = Point<3>(planes[0][i], 0., planes[2][k]);
          cell.size  = Tensor<1, 3>({planes[0][i + 1] - planes[0][i], 1., .5});
          cells.push_back(cell);
        }
    for (const double radius : {.45, .3, .1})
      cut(cells, radius);
    const auto                along = mesh::hexahedral_nodes(degree);
    const unsigned int        n     = along.size();
    std::vector<Tensor<1, 3>> values;
    for (const auto &cell : cells)
      for (unsigned int i = 0; i < n * n * n; ++i)
        {
          Point<3> p = cell.lower;
          for (unsigned int d = 0; d < 3; ++d)
            p[d] += cell.size[d] * along[d == 0 ? i % n : d == 1 ? i / n % n : i / n / n];
          values.push_back(quadratic(p));
        }
    return std::make_shared<HexahedralField>(degree, planes, cells, values);
  }

  void
  test_field(const unsigned int degree)
  {
    const auto u = field(degree);
    Random     random(7);
    double     largest = 0., gradient = 0.;
    bool       inside = true;
    for (unsigned int k = 0; k < 2000; ++k)
      {
        Point<3> p(random(), random(), random());
        if (k % 3 == 0)
          p *= .1;
        const auto at  = u->locate(p);
        largest        = std::max(largest, (u->value(at.cell, at.unit) - quadratic(p)).norm());
        const auto   G = u->gradient(at.cell, at.unit);
        Tensor<2, 3> exact;
        exact[0][0] = p[1], exact[0][1] = p[0], exact[1][1] = 2. * p[1], exact[1][2] = -.5;
        exact[2][0] = p[2], exact[2][2] = p[0] + 2. * p[2];
        gradient = std::max(gradient, (G - exact).norm());
        inside   = inside && at.distance == 0.;
      }
    const std::string name = "degree " + std::to_string(degree) + ", ";
    check(name + "values and gradients", inside && largest < 1e-14 && gradient < 1e-12);
    const auto outside = u->locate(Point<3>(1.5, .5, -1.));
    check(name + "a point outside",
          near(outside.distance, std::sqrt(1.25))
            && (u->value(outside.cell, outside.unit) - quadratic(Point<3>(1., .5, 0.))).norm()
                 < 1e-14);
    check(name + "smallest size",
          near(u->smallest_size(Point<3>(.01, .01, .01), Point<3>(.9, .9, .9), 0.), .125)
            && near(u->smallest_size(Point<3>(.5, .5, .6), Point<3>(.9, .9, .9), 0.), 1.));
  }

  void
  refuse(const std::string &what, std::vector<HexahedralField::Cell> cells)
  {
    const auto u = field(2);
    try
      {
        HexahedralField(1, u->planes(), cells, std::vector<Tensor<1, 3>>(8 * cells.size()));
        check(what + " refused", false);
      }
    catch (const core::NumericalError &)
      {
        check(what + " refused", true);
      }
  }

  scene::Scene
  beam()
  {
    scene::Scene              scene;
    scene::MaterialParameters material;
    material.name                       = "m";
    material.constants["Young modulus"] = 10.;
    material.constants["Poisson ratio"] = 0.3;
    scene.materials                     = {material};
    scene.mesh.source                   = scene::MeshSource::bricks;
    scene.mesh.upper_corner             = Point<3>(2, 1, 1);
    scene.mesh.cells                    = {{{4, 2, 2}}};
    scene::SupportParameters support;
    support.name            = "wall";
    support.selector.groups = {"x-min"};
    scene.supports          = {support};
    scene::LoadParameters load;
    load.name                 = "end";
    load.selector.groups      = {"x-max"};
    load.value                = {{"0", "0", "-1"}};
    scene.loads               = {load};
    scene.reference.type      = scene::ReferenceParameters::Type::hexahedra;
    scene.reference.tolerance = 0.05;
    scene.reference.degree    = 2;
    return scene;
  }

  /** Against differences to the exact solution, which are integrated elsewhere. */
  void
  test_differences()
  {
    const scene::Scene scene = beam();
    const auto         mesh  = cube(3, shaken(3, .2, 5));
    mesh->regions.assign(mesh->n_cells(), 0);
    const mechanics::MaterialMap materials(scene, *mesh);
    ReferenceField               reference;
    reference.hexahedra = field(3);
    const ReferenceSampling        sampling(reference, materials, MPI_COMM_WORLD);
    scene::ExactSolutionParameters exact_solution;
    exact_solution.displacement = {{"x*y + 0.3", "y*y - 0.5*z", "x*z + z*z"}};
    exact_solution.gradient     = {{"y", "x", "0", "0", "2*y", "-0.5", "z", "0", "x + 2*z"}};
    for (const unsigned int degree : {1, 2})
      {
        auto u_h = interpolate(mesh, degree, quadratic);
        for (unsigned int n = 0; n < u_h->n_nodes(); ++n)
          u_h->values[n][n % 3] += .05 * std::sin(1. + n);
        const auto d     = difference_to_hexahedra(*u_h, sampling);
        const auto exact = difference_to_exact(*u_h, exact_solution, materials, MPI_COMM_WORLD);
        const std::string name = "P" + std::to_string(degree) + ", ";
        check(name + "norms of the reference",
              near(d.energy_norm, exact.energy_norm) && near(d.h1_norm, exact.h1_norm)
                && near(d.l2_norm, exact.l2_norm));
        double cells = 0.;
        for (unsigned int c = 0; c < mesh->n_cells(); ++c)
          cells = std::max(cells, std::abs(d.cell_energy[c] - exact.cell_energy[c]));
        check(name + "energy norm of the difference", near(d.energy, exact.energy));
        check(name + "in each cell", cells < 1e-11 * exact.energy);
        check(name + "gradients", near(d.h1, exact.h1));
        // Differences of degree 2 and squares of degree 4: not exact by the rule.
        check(name + "values to 5 %", near(d.l2, exact.l2, .05));
        const auto ren       = nodal_ren(*u_h, sampling);
        const auto exact_ren = nodal_ren(*u_h, exact_solution, MPI_COMM_WORLD);
        check(name + "nodal errors",
              near(ren.mean, exact_ren.mean, 1e-10) && near(ren.max, exact_ren.max, 1e-10)
                && ren.largest_distance == 0.);
      }
  }

  void
  test_cache()
  {
    const std::string directory     = "hexahedra_test_cache";
    scene::Scene      scene         = beam();
    scene.reference.cache_directory = directory;
    if (first_rank)
      std::filesystem::remove_all(directory);
    MPI_Barrier(MPI_COMM_WORLD);
    const auto mesh = std::make_shared<mesh::TetMesh>(io::make_mesh(scene, 0, core::Log()));
    const mechanics::MaterialMap materials(scene, *mesh);
    const auto                   make
      = [&] { return make_reference(scene, materials, mesh, MPI_COMM_WORLD, {}, {}); };
    const Reference a = make(), b = make();
    const auto     &u = *a.displacement.hexahedra, &v = *b.displacement.hexahedra;
    check("solved, then reused", !a.from_cache && b.from_cache);
    check("with the same values",
          u.values().size() == v.values().size()
            && std::memcmp(u.values().data(),
                           v.values().data(),
                           u.values().size() * sizeof(Tensor<1, 3>))
                 == 0
            && u.planes() == v.planes() && u.n_cells() == v.n_cells());
    check("and figures",
          a.energy == b.energy && a.estimated_error == b.estimated_error && a.known_energy
            && a.known_energy == b.known_energy && a.description == b.description);
    check("known energy above that of the reference", *a.known_energy > a.energy);
    const ReferenceSampling sampling(b.displacement, materials, MPI_COMM_WORLD);
    check("energy by quadrature", near(std::pow(sampling.energy_norm(), 2), a.energy, 1e-6));

    const std::string key   = reference_key(scene, *mesh);
    auto              other = scene;
    other.mesh.cells        = {{{6, 3, 3}}};
    check("another mesh of tetrahedra, same key",
          key == reference_key(other, io::make_mesh(other, 0, core::Log())));
    other                     = scene;
    other.reference.tolerance = 0.04;
    check("another tolerance, another key", key != reference_key(other, *mesh));
    if (first_rank)
      std::filesystem::remove_all(directory);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  test_field(2);
  test_field(3);
  auto cells = field(2)->cells();
  cells.push_back(cells.back());
  refuse("overlapping cells", cells);
  cells = field(2)->cells();
  cells.erase(cells.begin() + 3);
  refuse("a missing cell", cells);
  test_differences();
  test_cache();
}
