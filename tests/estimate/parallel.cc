// SPDX-License-Identifier: AGPL-3.0-or-later

// Comparisons and estimates shared out over the ranks give what one rank gives,
// and an error on one rank is thrown on all.

#include "tetradapt/compare/parallel.h"
#include "tetradapt/compare/difference.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/failure.h"
#include "tetradapt/estimate/recovery/recovery.h"



#include "../compare/test_meshes.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>

using namespace test_meshes;
using namespace tetradapt::compare;
using namespace tetradapt::estimate;

namespace
{
  double
  largest_difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    if (a.size() != b.size())
      return 1e300;
    double scale = 0., largest = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      {
        scale   = std::max(scale, std::abs(a[i]));
        largest = std::max(largest, std::abs(a[i] - b[i]));
      }
    return largest / scale;
  }

  void
  report(const std::string &name, const std::vector<double> &a, const std::vector<double> &b)
  {
    if (this_rank(MPI_COMM_WORLD) == 0)
      std::cout << name << ": " << (largest_difference(a, b) < 1e-12 ? "equal" : "DIFFERENT")
                << std::endl;
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (this_rank(MPI_COMM_WORLD) == 0)
    std::cout << "ranks: " << n_ranks(MPI_COMM_WORLD) << std::endl;

  const auto u = [](const Point<3> &p) {
    return Tensor<1, 3>({std::sin(3. * p[0]), p[1] * p[2], std::exp(p[0] - p[2])});
  };
  const auto   coarse = cube(3, shaken(3, .2, 1)), fine = cube(5, shaken(5, .2, 2));
  scene::Scene scene;
  scene.materials.resize(1);
  const mechanics::MaterialMap materials(scene, *coarse);
  const auto                   u_h = interpolate(coarse, 1, u), reference = interpolate(fine, 2, u);
  const PointLocator           locator(coarse), fine_locator(fine);
  scene::ExactSolutionParameters exact_solution;
  exact_solution.displacement = {{"sin(3*x)", "y*z", "exp(x-z)"}};

  const auto numbers = [](const Difference &d) {
    std::vector<double> all = d.cell_energy;
    all.insert(all.end(), {d.l2, d.h1, d.energy, d.l2_norm, d.h1_norm, d.energy_norm});
    return all;
  };
  const auto to_reference = [&](MPI_Comm communicator) {
    return numbers(difference_to_reference(*u_h, locator, *reference, materials, communicator));
  };
  report("difference", to_reference(MPI_COMM_WORLD), to_reference(MPI_COMM_SELF));
  // The other way round, most cells hold no point of the reference.
  const auto to_coarse = [&](MPI_Comm communicator) {
    return numbers(
      difference_to_reference(*reference, fine_locator, *u_h, materials, communicator));
  };
  report("difference to a coarse one", to_coarse(MPI_COMM_WORLD), to_coarse(MPI_COMM_SELF));
  const auto to_exact = [&](MPI_Comm communicator) {
    return numbers(difference_to_exact(*u_h, exact_solution, materials, communicator));
  };
  report("exact", to_exact(MPI_COMM_WORLD), to_exact(MPI_COMM_SELF));
  const auto ren = [&](MPI_Comm communicator) {
    return nodal_ren(*u_h, fine_locator, *reference, communicator).values;
  };
  report("REN", ren(MPI_COMM_WORLD), ren(MPI_COMM_SELF));
  const auto recovery = [&](MPI_Comm communicator) {
    return recovery_estimate(*reference, materials, communicator).cell_energy;
  };
  report("recovery", recovery(MPI_COMM_WORLD), recovery(MPI_COMM_SELF));

  try
    {
      core::together(MPI_COMM_WORLD, [&] {
        if (this_rank(MPI_COMM_WORLD) + 1 == n_ranks(MPI_COMM_WORLD))
          throw core::InputError("only the last rank failed");
      });
      std::cout << "NOT THROWN" << std::endl;
    }
  catch (const core::InputError &error)
    {
      if (this_rank(MPI_COMM_WORLD) == 0)
        std::cout << "thrown on rank 0: " << error.what() << std::endl;
    }
}
