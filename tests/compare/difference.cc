// SPDX-License-Identifier: AGPL-3.0-or-later

// Norms of differences of polynomial fields, whose values are known exactly, and
// the report's REN with its zero rules; the quadrature rules on all monomials.

#include "tetradapt/compare/difference.h"
#include "tetradapt/compare/exact_solution.h"
#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/core/exceptions.h"

#include "test_meshes.h"

#include <cmath>
#include <iomanip>
#include <iostream>

using namespace test_meshes;
using namespace tetradapt::compare;

namespace
{
  /** E = 1000, nu = 0.25: lambda = mu = 400. */
  mechanics::MaterialMap
  materials(const mesh::TetMesh &mesh)
  {
    scene::Scene              scene;
    scene::MaterialParameters material;
    material.name                       = "material";
    material.constants["Young modulus"] = 1000.;
    material.constants["Poisson ratio"] = 0.25;
    scene.materials.push_back(material);
    return mechanics::MaterialMap(scene, mesh);
  }

  void
  check(const std::string &name, const double value, const double exact, const double tolerance)
  {
    const bool right = std::abs(value - exact) <= tolerance * std::max(std::abs(exact), 1e-300);
    std::cout << name << ": " << (right ? "exact" : "WRONG") << ", " << exact;
    if (!right)
      std::cout << " but computed " << std::setprecision(16) << value << std::setprecision(7);
    std::cout << std::endl;
  }

  double
  factorial(const unsigned int n)
  {
    return n < 2 ? 1. : n * factorial(n - 1);
  }

  void
  check_quadrature()
  {
    for (const unsigned int degree : {1, 2, 5, 6})
      {
        const auto &rule     = tet_quadrature(degree);
        double      worst    = 0.;
        bool        positive = true;
        // int b0^i b1^j b2^k over the unit tetrahedron by its volume:
        // 3! i! j! k! / (i + j + k + 3)!
        for (unsigned int i = 0; i <= degree; ++i)
          for (unsigned int j = 0; i + j <= degree; ++j)
            for (unsigned int k = 0; i + j + k <= degree; ++k)
              {
                double sum = 0.;
                for (unsigned int q = 0; q < rule.points.size(); ++q)
                  {
                    const auto &b = rule.points[q];
                    sum += rule.weights[q] * std::pow(b[0], i) * std::pow(b[1], j)
                           * std::pow(b[2], k);
                    positive = positive && rule.weights[q] > 0. && b[0] > 0. && b[3] > 0.;
                  }
                const double exact
                  = 6. * factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3);
                worst = std::max(worst, std::abs(sum - exact) / exact);
              }
        std::cout << "rule of degree " << degree << ": " << rule.points.size() << " points, "
                  << (worst < 1e-13 ? "exact" : "WRONG") << ", "
                  << (positive ? "positive" : "NOT POSITIVE") << std::endl;
      }
  }

  Tensor<1, 3>
  vector(const double x, const double y, const double z)
  {
    return Tensor<1, 3>({x, y, z});
  }
} // namespace

int
main()
{
  std::cout << std::setprecision(7);
  check_quadrature();

  const auto coarse = cube(3, shaken(3, 0.2, 1));
  const auto fine   = cube(7, shaken(7, 0.2, 2));
  const auto laws   = materials(*coarse);
  const auto zero   = [](const Point<3> &) { return Tensor<1, 3>(); };

  // u - u_h = (x, 2y, -z): |.|^2 integrates to (1 + 4 + 1)/3; grad: 1 + 4 + 1;
  // energy: 400 (1+2-1)^2 + 800 (1 + 4 + 1) = 6400. u = 2 (u - u_h).
  for (const unsigned int degree : {1, 2})
    {
      const auto u_h = interpolate(coarse, degree, [](const Point<3> &p) {
        return vector(p[0], 2. * p[1], -p[2]);
      });
      const auto u   = interpolate(fine, 3 - degree, [](const Point<3> &p) {
        return vector(2. * p[0], 4. * p[1], -2. * p[2]);
      });
      const auto d   = difference_to_reference(*u_h, PointLocator(coarse), *u, laws, MPI_COMM_SELF);
      std::cout << "Linear difference, degrees " << degree << " and " << 3 - degree << std::endl;
      // The points of the rule that u - u_h is integrated with are exact here.
      check("l2", d.l2, std::sqrt(2.), 1e-12);
      check("h1", d.h1, std::sqrt(6.), 1e-12);
      check("energy", d.energy, 80., 1e-12);
      check("l2 norm", d.l2_norm, 2. * std::sqrt(2.), 1e-12);
      check("h1 norm", d.h1_norm, 2. * std::sqrt(6.), 1e-12);
      check("energy norm", d.energy_norm, 160., 1e-12);
      double sum = 0.;
      for (const double e : d.cell_energy)
        sum += e * e;
      check("sum over the cells", sum, 6400., 1e-12);
      check("unsampled", d.n_unsampled_cells, 0., 0.);
      check("distance", d.largest_distance, 0., 0.);
    }

  // Quadratic on one mesh: u_h = 0, u = (x^2, 0, 0): energy 1200 * 4/3.
  const auto quadratic
    = interpolate(fine, 2, [](const Point<3> &p) { return vector(p[0] * p[0], 0., 0.); });
  {
    const auto d = difference_to_reference(
      *interpolate(coarse, 2, zero), PointLocator(coarse), *quadratic, laws, MPI_COMM_SELF);
    std::cout << "Quadratic reference" << std::endl;
    check("energy", d.energy, 40., 1e-12);
    check("h1", d.h1, std::sqrt(4. / 3.), 1e-12);
    check("l2 norm", d.l2_norm, std::sqrt(0.2), 1e-12);
  }

  // A reference coarser than u_h leaves cells without points; their indicators
  // are integrated on their own: volume times the constant density 1200.
  {
    const auto u   = interpolate(coarse, 1, [](const Point<3> &p) { return vector(p[0], 0., 0.); });
    const auto u_h = interpolate(fine, 1, zero);
    const auto d   = difference_to_reference(*u_h, PointLocator(fine), *u, laws, MPI_COMM_SELF);
    const unsigned int least = fine->n_cells() - 4 * coarse->n_cells();
    unsigned int       right = 0;
    for (unsigned int cell = 0; cell < fine->n_cells(); ++cell)
      right += std::abs(std::pow(d.cell_energy[cell], 2) - 1200. * mesh::cell_volume(*fine, cell))
               < 1e-11;
    std::cout << "Coarse reference: at least " << least << " cells without points "
              << (d.n_unsampled_cells >= least ? "found" : "NOT FOUND") << ", all of them "
              << (right >= d.n_unsampled_cells ? "right" : "WRONG") << std::endl;
    check("energy", d.energy, std::sqrt(1200.), 1e-12);
  }

  // Exact solutions: u = (x^3, x y z, sin z) against u_h = 0. Densities:
  // grad: 9x^4 + (yz)^2 + (xz)^2 + (xy)^2 + cos^2 z.
  {
    scene::ExactSolutionParameters exact_solution;
    exact_solution.displacement = {{"x^3", "x*y*z", "sin(z)"}};
    const double l2             = 1. / 7. + 1. / 27. + .5 - std::sin(2.) / 4.;
    const double h1             = 9. / 5. + 3. / 9. + .5 + std::sin(2.) / 4.;
    // With eps_xx = 3x^2, eps_yy = xz, eps_zz = cos z, eps_xy = yz/2, eps_yz = xy/2:
    // 400 tr^2 + 800 eps:eps, integrated over the unit cube.
    const double c = std::sin(1.), cc = .5 + std::sin(2.) / 4.;
    const double zc            = std::sin(1.) + std::cos(1.) - 1.; // int z cos z
    const double diag          = 9. / 5. + 1. / 9. + cc;
    const double trace_squared = diag + 2. * (3. / 8. + c + zc / 2.);
    const double energy        = 400. * trace_squared + 800. * (diag + 2. * (1. / 36. + 1. / 36.));
    const auto   mesh          = cube(6, shaken(6, 0.2, 4));
    const auto   by_differences
      = difference_to_exact(*interpolate(mesh, 2, zero), exact_solution, laws, MPI_COMM_SELF);
    std::cout << "Exact solution" << std::endl;
    check("l2", by_differences.l2, std::sqrt(l2), 1e-9);
    check("h1", by_differences.h1, std::sqrt(h1), 1e-9);
    check("energy", by_differences.energy, std::sqrt(energy), 1e-9);
    check("energy norm", by_differences.energy_norm, std::sqrt(energy), 1e-9);
    exact_solution.gradient = {{"3*x^2", "0", "0", "y*z", "x*z", "x*y", "0", "0", "cos(z)"}};
    const auto by_gradient
      = difference_to_exact(*interpolate(mesh, 1, zero), exact_solution, laws, MPI_COMM_SELF);
    check("energy, gradient given", by_gradient.energy, std::sqrt(energy), 1e-7);
    check("differences against gradient",
          by_differences.cell_energy[100],
          difference_to_exact(*interpolate(mesh, 2, zero), exact_solution, laws, MPI_COMM_SELF)
            .cell_energy[100],
          1e-10);
    // The quadratic interpolant of a quadratic solution is exact.
    exact_solution.displacement = {{"x*y", "z^2", "1+x"}};
    exact_solution.gradient     = {};
    const auto none
      = difference_to_exact(*interpolate(mesh,
                                         2,
                                         [](const Point<3> &p) {
                                           return vector(p[0] * p[1], p[2] * p[2], 1. + p[0]);
                                         }),
                            exact_solution,
                            laws,
                            MPI_COMM_SELF);
    std::cout << "interpolant of a quadratic solution: relative error "
              << (none.energy < 1e-9 * none.energy_norm ? "below" : "ABOVE") << " 1e-9"
              << std::endl;
    exact_solution.displacement = {{"sqrt(x-0.5)", "0", "0"}};
    try
      {
        difference_to_exact(*interpolate(mesh, 1, zero), exact_solution, laws, MPI_COMM_SELF);
        std::cout << "NOT REFUSED" << std::endl;
      }
    catch (const core::InputError &)
      {
        std::cout << "values that are not finite are refused" << std::endl;
      }
  }

  // REN: u = (x, 0, 0) on the fine mesh, u_h = 1.25 u except where it is equal:
  // 0.25 at every node with x > 0 that differs.
  {
    const auto   u   = interpolate(fine, 2, [](const Point<3> &p) { return vector(p[0], 0., 0.); });
    const auto   u_h = interpolate(coarse, 2, [](const Point<3> &p) {
      return vector(p[1] == 1. ? p[0] : 1.25 * p[0], p[0] == 0. ? 3. : 0., 0.);
    });
    unsigned int n_nodes = 0, n_points = 0;
    for (unsigned int n = 0; n < u_h->n_nodes(); ++n)
      if (u_h->node_position(n)[0] > 0. && u_h->node_position(n)[1] < 1.)
        {
          ++n_nodes;
          n_points += n < coarse->n_points();
        }
    const auto ren = nodal_ren(*u_h, PointLocator(fine), *u, MPI_COMM_SELF);
    std::cout << "REN" << std::endl;
    check("max", ren.max, 0.25, 1e-10);
    check("mean", ren.mean, 0.25 * n_nodes / u_h->n_nodes(), 1e-10);
    check("mean of points", ren.mean_of_points, 0.25 * n_points / coarse->n_points(), 1e-10);
    check("nodes", n_nodes, 7. * 7. * 7. - 7. * 7. - 7. * 6., 0.);
    double largest = 0.;
    for (const double sum : ren.cell_sums)
      largest = std::max(largest, sum);
    check("largest sum over a cell", largest, 2.5, 1e-10);
    check("at a point with u = 0", ren.values[0], 0., 0.);
    scene::ExactSolutionParameters exact_solution;
    exact_solution.displacement = {{"x", "0", "0"}};
    check("mean, exact displacement",
          nodal_ren(*u_h, exact_solution, MPI_COMM_SELF).mean,
          ren.mean,
          1e-10);
    check("of the reference itself",
          nodal_ren(*u, PointLocator(fine), *u, MPI_COMM_SELF).max,
          0.,
          0.);
    check("of a reference at rest",
          nodal_ren(*u_h, PointLocator(fine), *interpolate(fine, 1, zero), MPI_COMM_SELF).max,
          0.,
          0.);
  }
}
