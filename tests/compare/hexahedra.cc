// SPDX-License-Identifier: AGPL-3.0-or-later

// A reference on hexahedra: points are found, differences and nodal errors are those to
// the exact solution; on one and two ranks.

#include "tetradapt/compare/difference.h"
#include "tetradapt/core/exceptions.h"

#include "test_meshes.h"

#include <deal.II/base/mpi.h>

#include <cmath>
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
  one_material()
  {
    scene::Scene              scene;
    scene::MaterialParameters material;
    material.name                       = "m";
    material.constants["Young modulus"] = 10.;
    material.constants["Poisson ratio"] = 0.3;
    scene.materials                     = {material};
    return scene;
  }

  /** Against differences to the exact solution, which are integrated elsewhere. */
  void
  test_differences()
  {
    const scene::Scene scene = one_material();
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
}
