// SPDX-License-Identifier: AGPL-3.0-or-later

// Patch recovery: stresses that the patches' polynomials contain are recovered
// exactly, region by region, on bad meshes and in corners, also where they have to
// meet tractions, supports and body forces; and on the uniform mesh, where centroids
// are superconvergent, the estimate is the true error.

#include "tetradapt/estimate/recovery/recovery.h"
#include "tetradapt/compare/difference.h"
#include "tetradapt/compare/exact_solution.h"

#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/selection.h"

#include "../compare/test_meshes.h"

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace test_meshes;
using namespace tetradapt::compare;
using namespace tetradapt::estimate;

namespace
{
  /** Two materials, one a region; and a temperature if one is given. */
  scene::Scene
  scene_with(const std::string &temperature)
  {
    scene::Scene scene;
    scene.materials.resize(2);
    for (int i = 0; i < 2; ++i)
      {
        scene.materials[i].name                       = i == 0 ? "soft" : "hard";
        scene.materials[i].regions                    = {i};
        scene.materials[i].constants["Young modulus"] = i == 0 ? 1000. : 50000.;
        scene.materials[i].constants["Poisson ratio"] = i == 0 ? 0.25 : 0.4;
        scene.materials[i].thermal_expansion          = 0.01;
      }
    if (!temperature.empty())
      {
        scene.loads.resize(1);
        scene.loads[0].name     = "heat";
        scene.loads[0].type     = scene::LoadType::temperature;
        scene.loads[0].value[0] = temperature;
      }
    return scene;
  }

  /** Estimate over the energy norm of the field, or, where it has none without its thermal
   * strain, over the root of int 2 mu |grad u|^2. */
  double
  relative_estimate(std::shared_ptr<const mesh::TetMesh>                 mesh,
                    const unsigned int                                   degree,
                    const std::function<Tensor<1, 3>(const Point<3> &)> &u,
                    const std::string                                   &temperature = "")
  {
    const mechanics::MaterialMap materials(scene_with(temperature), *mesh);
    const auto                   u_h = interpolate(mesh, degree, u);
    const ReferenceSampling      sampling(u_h, materials, MPI_COMM_SELF);
    return recovery_estimate(*u_h, materials, MPI_COMM_SELF).global
           / (temperature.empty() ? sampling.energy_norm()
                                  : sampling.energy_noise() / mechanics::EnergyNorm::rounding);
  }

  void
  add_load(scene::Scene &scene, const std::string &group, const std::array<std::string, 3> &value)
  {
    scene::LoadParameters load;
    load.name  = group.empty() ? "inside" : group;
    load.type  = group.empty() ? scene::LoadType::body_force : scene::LoadType::traction;
    load.value = value;
    if (!group.empty())
      load.selector.groups = {group};
    scene.loads.push_back(load);
  }

  /**
   * The displacement (x^2 + 2yz, z - xy, 3x + z^2) with lambda = mu = 400 has the stresses
   * xx 400(5x+2z), yy 400(2z-x), zz 400(x+6z), xy 400(2z-y), xz 400(2y+3), yz 400: with the
   * body force (-1600, 0, -2400) they are in equilibrium.
   *
   * @param top the traction's x component on z = 1, 400(2y+3) if it is right.
   */
  double
  estimate_in_equilibrium(const unsigned int degree, const std::string &top)
  {
    scene::Scene scene = scene_with("");
    scene.supports.resize(2);
    scene.supports[0].name            = "x-min";
    scene.supports[0].selector.groups = {"x-min"};
    scene.supports[0].displacement    = {{"x^2+2*y*z", "z-x*y", "3*x+z^2"}};
    scene.supports[1].name            = "y-min";
    scene.supports[1].selector.groups = {"y-min"};
    scene.supports[1].components      = {{false, true, false}};
    scene.supports[1].displacement    = {{"0", "z-x*y", "0"}};
    add_load(scene, "", {{"-1600", "0", "-2400"}});
    add_load(scene, "x-max", {{"400*(5*x+2*z)", "400*(2*z-y)", "400*(2*y+3)"}});
    add_load(scene, "y-min", {{"-400*(2*z-y)", "1e6", "-400"}}); // y is held: not a load
    add_load(scene, "y-max", {{"400*(2*z-y)", "400*(2*z-x)", "400"}});
    add_load(scene, "z-min", {{"-400*(2*y+3)", "-400", "-400*(x+6*z)"}});
    add_load(scene, "z-max", {{top, "400", "400*(x+6*z)"}});
    const unsigned int n    = degree == 1 ? 8 : 4;
    auto               mesh = std::make_shared<mesh::TetMesh>(
      mesh::bricks(Point<3>(0., 0., 0.), Point<3>(1., 1., 1.), {{n, n, n}}));
    const auto shake = shaken(n, degree == 1 ? 0. : 0.2, 7);
    for (auto &point : mesh->points)
      point = shake(point);
    std::vector<std::pair<std::string, scene::Selector>> selectors;
    for (const auto &support : scene.supports)
      selectors.emplace_back("Supports/" + support.name, support.selector);
    for (const auto &load : scene.loads)
      if (load.type == scene::LoadType::traction)
        selectors.emplace_back("Loads/" + load.name, load.selector);
    mesh::select_faces(*mesh, selectors);
    scene.materials.resize(1);
    scene.materials[0].regions.clear();
    const mechanics::MaterialMap materials(scene, *mesh);
    const auto                   u_h = interpolate(mesh, degree, [](const Point<3> &p) {
      return Tensor<1, 3>(
        {p[0] * p[0] + 2. * p[1] * p[2], p[2] - p[0] * p[1], 3. * p[0] + p[2] * p[2]});
    });
    const double estimate = recovery_estimate(*u_h, materials, MPI_COMM_SELF, &scene).global;
    if (degree == 2)
      return estimate;
    scene::ExactSolutionParameters exact_solution;
    exact_solution.displacement = scene.supports[0].displacement;
    return estimate / difference_to_exact(*u_h, exact_solution, materials, MPI_COMM_SELF).energy;
  }

  void
  check_zero(const std::string &name, const double estimate)
  {
    std::cout << name << ": " << (estimate < 1e-9 ? "exact" : "WRONG") << std::endl;
    if (!(estimate < 1e-9))
      std::cout << estimate << std::endl;
  }
  /** Whether every patch of two regions gets the nearest cells of its region, no more than
   * it must, and all at the same distance. */
  bool
  nearest_cells_are_right(const mesh::TetMesh &mesh, const unsigned int n_cells)
  {
    const RecoveryPatches     patches(mesh);
    std::vector<unsigned int> own, largest, cells;
    for (unsigned int patch = 0; patch < patches.size(); ++patch)
      {
        patches.cells_of(patch, 0, own);
        patches.cells_of(patch, 2, largest);
        patches.nearest_cells(mesh, patch, n_cells, cells);
        const auto distance = [&](const unsigned int cell) {
          Tensor<1, 3> center;
          for (const unsigned int v : mesh.cells[cell])
            center += 0.25 * Tensor<1, 3>(mesh.points[v]);
          return Point<3>(center).distance(mesh.points[patches.vertex[patch]]);
        };
        double       farthest = 0.;
        unsigned int nearer   = own.size(); // cells of the patch and nearer than the farthest
        for (const unsigned int cell : cells)
          if (!std::binary_search(own.begin(), own.end(), cell))
            farthest = std::max(farthest, distance(cell));
        for (const unsigned int cell : cells)
          nearer += !std::binary_search(own.begin(), own.end(), cell)
                    && distance(cell) < farthest * (1. - 1e-6);
        if (!std::includes(cells.begin(), cells.end(), own.begin(), own.end())
            || !std::includes(largest.begin(), largest.end(), cells.begin(), cells.end())
            || cells.size() < std::min<std::size_t>(n_cells, largest.size())
            || (cells.size() > own.size() && nearer >= n_cells))
          return false;
        patches.cells_of(patch, 1, largest);
        for (const unsigned int cell : largest)
          if (cells.size() > own.size() && distance(cell) < farthest * (1. - 1e-6)
              && !std::binary_search(cells.begin(), cells.end(), cell))
            return false; // left out, although it is near
        for (const unsigned int cell : cells)
          if (mesh.regions[cell] != mesh.regions[own[0]])
            return false;
      }
    return true;
  }
} // namespace

int
main()
{
  const auto linear = [](const Point<3> &p) {
    return Tensor<1, 3>({p[0] + 2. * p[1], p[2] - p[1], 3. * p[0]});
  };
  const auto quadratic = [](const Point<3> &p) {
    return Tensor<1, 3>(
      {p[0] * p[0] + 2. * p[1] * p[2], p[2] - p[1] * p[0], 3. * p[0] + p[2] * p[2]});
  };
  const auto shake = shaken(6, 0.25, 5);
  const auto flat  = [&](const Point<3> &p) {
    const Point<3> q = shake(p);
    return Point<3>(q[0] + q[1], q[1] - 0.3 * q[0], 1e-3 * q[2] + 0.3 * q[0]);
  };
  const auto same = [](const Point<3> &p) { return p; };
  for (const unsigned int n : {1, 10, 38, 1000})
    std::cout << "nearest " << n << " cells: "
              << (nearest_cells_are_right(*cube(4, same), n)
                      && nearest_cells_are_right(*cube(6, shake), n)
                    ? "right"
                    : "WRONG")
              << std::endl;
  for (unsigned int degree = 1; degree <= 2; ++degree)
    {
      const auto u
        = degree == 1 ? std::function<Tensor<1, 3>(const Point<3> &)>(linear) : quadratic;
      std::string name = "degree " + std::to_string(degree) + ", ";
      check_zero(name + "shaken, two materials", relative_estimate(cube(6, shake), degree, u));
      check_zero(name + "flat cells", relative_estimate(cube(6, flat), degree, u));
      check_zero(name + "eight bricks", relative_estimate(cube(2, same), degree, u));
      auto brick     = cube(1, same);
      brick->regions = {0, 0, 0, 1, 1, 1};
      check_zero(name + "one brick", relative_estimate(brick, degree, linear));
    }
  // A body that expands freely: u = 0.01 (T x - ...) with strain alpha T I for a
  // temperature linear in x, y, z has no stress at all.
  check_zero("free expansion",
             relative_estimate(
               cube(4, shaken(4, .2, 6)),
               2,
               [](const Point<3> &p) {
                 return Tensor<1, 3>({.01 * (p[0] + p[0] * p[0] - p[1] * p[1] - p[2] * p[2]),
                                      .01 * (p[1] + 2. * p[0] * p[1]),
                                      .01 * (p[2] + 2. * p[0] * p[2])});
               },
               "1 + 2*x"));

  // Degree 2 has the exact stress already. Degree 1 recovers a linear stress: it is the
  // exact one inside, and near it at the boundary, which conditions determine.
  check_zero("degree 2, in equilibrium", estimate_in_equilibrium(2, "400*(2*y+3)"));
  std::cout << "degree 2, wrong traction: "
            << (estimate_in_equilibrium(2, "400*(2*y+4)") > 1. ? "seen" : "NOT SEEN") << std::endl;
  const double with_loads = estimate_in_equilibrium(1, "400*(2*y+3)");
  std::cout << "degree 1, in equilibrium: effectivity "
            << (std::abs(with_loads - 1.) < 0.02 ? "near 1" : "WRONG") << std::endl;
  if (!(std::abs(with_loads - 1.) < 0.02))
    std::cout << with_loads << std::endl;

  for (unsigned int degree = 1; degree <= 2; ++degree)
    {
      const unsigned int n    = 12;
      auto               mesh = cube(n, same);
      mesh->regions.assign(mesh->n_cells(), 0);
      const mechanics::MaterialMap   materials(scene_with(""), *cube(2, same));
      scene::ExactSolutionParameters exact_solution;
      if (degree == 1)
        exact_solution.displacement = {{"x*x+2*y*z", "z-y*x", "3*x+z*z"}};
      else
        exact_solution.displacement = {{"x^3+2*x*y*z", "z-y*x^2", "3*x+z*z*y"}};
      const ExactSolution exact(exact_solution);
      const auto u_h = interpolate(mesh, degree, [&](const Point<3> &p) { return exact.value(p); });
      const auto estimate = recovery_estimate(*u_h, materials, MPI_COMM_SELF);
      const auto error    = difference_to_exact(*u_h, exact_solution, materials, MPI_COMM_SELF);
      double     worst    = 0.;
      for (unsigned int cell = 0; cell < mesh->n_cells(); ++cell)
        {
          bool inner = true;
          for (const unsigned int v : mesh->cells[cell])
            for (unsigned int d = 0; d < 3; ++d)
              inner = inner && std::abs(mesh->points[v][d] - 0.5) < 0.5 - 0.5 / n;
          if (inner)
            worst = std::max(worst,
                             std::abs(estimate.cell_energy[cell] / error.cell_energy[cell] - 1.));
        }
      // Degree 1: the interpolant's derivative along an edge is exact in the edge's
      // middle, and the patches are symmetric: the recovered stress is the true
      // one away from the boundary. Degree 2: close to it.
      const double effectivity = estimate.global / error.energy;
      std::cout << "uniform mesh, degree " << degree << ": inner cells "
                << (worst < (degree == 1 ? 1e-9 : 0.05) ? "right" : "WRONG") << ", effectivity "
                << (effectivity > 0.9 && effectivity < 1.1 ? "between" : "NOT BETWEEN")
                << " 0.9 and 1.1" << std::endl;
    }
}
