// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Extrapolation of the degree finds the error itself where the next degree holds the
// displacement, in all and in every cell, with prescribed displacements of that degree.

#include "tetradapt/estimate/extrapolation.h"

#include "polynomials.h"

#include <deal.II/base/mpi.h>

using namespace polynomials;

namespace
{
  void
  test(const std::string &name, const scene::Scene &scene, const unsigned int n)
  {
    const Solved solved(scene, n);
    const auto   estimate = solved(estimate::DegreeExtrapolation());
    const auto  &exact    = solved.comparison->to_exact_solution();
    double       worst = 0., squares = 0.;
    for (unsigned int cell = 0; cell < solved.body->n_cells(); ++cell)
      {
        worst = std::max(worst, std::abs(estimate.indicators[cell] - exact.cell_energy[cell]));
        squares += std::pow(estimate.indicators[cell], 2);
      }
    const double index = estimate.global / exact.energy;
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    std::cout << name << ", P" << scene.degree << ", " << solved.body->n_cells() << " cells\n";
    // The heated body has no stress: then of the root of int 2 mu |grad u|^2.
    const double scale = exact.energy_norm > 1e-6 * exact.energy
                           ? exact.energy_norm
                           : exact.energy_noise / mechanics::EnergyNorm::rounding;
    check("  there is an error, of 0.5 to 30 %",
          exact.energy > 0.005 * scale && exact.energy < 0.3 * scale);
    check("  the estimate is the error to 2 %", std::abs(index - 1.) < 0.02);
    check("  in every cell to 2 % of the whole", worst < 0.02 * exact.energy);
    check("  root of squares", std::sqrt(squares), estimate.global, estimate.global, 1e-12);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int degree : {1, 2})
    for (const unsigned int n : {3, 5})
      test("polynomial", make_scene(degree), n);
  test("heated", make_heated_scene(), 5);
}
