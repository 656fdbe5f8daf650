// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/equilibrated/equilibrated.h"

#include "bound.h"

#include "tetradapt/fem/replication.h"
#include "tetradapt/solve/energies.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    /** A bound that is above what it bounds by no more than this factor is sharp enough. */
    constexpr double sharp = 1.2;

    struct Quadratic
    {
      std::shared_ptr<const mesh::NodalField> solution;
      double distance = 0.; ///< energy norm, to the linear solution
    };

    /** Solves with degree 2 on the mesh of a solution of degree 1. */
    Quadratic
    solve_quadratic(const EstimateInput &input)
    {
      const mesh::NodalField   &linear = input.comparison.displacement();
      const solve::StaticSystem system(input.scene,
                                       input.comparison.material_map(),
                                       linear.shared_mesh(),
                                       2,
                                       input.comparison.mpi_communicator(),
                                       core::Log());
      mesh::NodalField          start(linear.shared_mesh(), 2);
      const auto               &edges    = start.edges().edges;
      const unsigned int        n_points = linear.n_nodes();
      for (unsigned int i = 0; i < n_points; ++i)
        start.values[i] = linear.values[i];
      for (unsigned int e = 0; e < edges.size(); ++e)
        start.values[n_points + e]
          = 0.5 * (linear.values[edges[e][0]] + linear.values[edges[e][1]]);
      Quadratic result;
      result.solution = fem::replicate(
        *system.solve(fem::distribute(start, system.space()).get(), {}).displacement);
      for (unsigned int i = 0; i < start.n_nodes(); ++i)
        start.values[i] -= result.solution->values[i];
      result.distance
        = std::sqrt(std::max(0.,
                             solve::compute_energies(*fem::distribute(start, system.space()),
                                                     input.comparison.material_map())
                               .energy));
      return result;
    }
  } // namespace

  EstimatorTraits
  Equilibrated::traits() const
  {
    EstimatorTraits traits;
    traits.name          = "equilibrated";
    traits.documentation = "Distance of the stress to one that is in equilibrium with the loads "
                           "at every point (Prager and Synge, 1947). A bound of the energy norm "
                           "of the error without any unknown constant.";
    traits.needs_equilibrium = true;
    return traits;
  }

  Estimate
  Equilibrated::estimate(const EstimateInput &input) const
  {
    const mesh::NodalField &u_h = input.comparison.displacement();
    Quadratic               quadratic;
    if (u_h.degree() == 1)
      quadratic = solve_quadratic(input);
    EquilibratedBound bound
      = equilibrated_bound(u_h,
                           quadratic.solution == nullptr ? u_h : *quadratic.solution,
                           input.scene,
                           input.comparison.material_map(),
                           input.comparison.mpi_communicator(),
                           sharp * quadratic.distance);
    // The theorem is about the discrete equations' exact solution.
    return {std::move(bound.cell_energy), bound.global + input.solution.algebraic_error};
  }
} // namespace tetradapt::estimate
