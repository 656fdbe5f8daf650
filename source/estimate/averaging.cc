// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/root_of_squares.h"
#include "tetradapt/estimate/flux_projection.h"
#include "tetradapt/estimate/recovery/averaged_stress.h"
#include "tetradapt/estimate/stress_difference.h"

namespace tetradapt::estimate
{
  EstimatorTraits
  Averaging::traits() const
  {
    EstimatorTraits traits;
    traits.name = "averaging";
    traits.documentation
      = "Energy norm of the difference between the stress and its averages at "
        "the nodes (Zienkiewicz and Zhu 1987), one-sided at interfaces of "
        "regions, corrected on the boundary by tractions and supports. No bound.";
    return traits;
  }

  Estimate
  Averaging::estimate(const EstimateInput &input) const
  {
    const mesh::NodalField       &u_h       = input.comparison.displacement();
    const mechanics::MaterialMap &materials = input.comparison.material_map();
    const CellStress              stress(u_h, materials);
    const GivenLoads              loads(input.scene, materials, u_h);
    const AveragedStress          averages(u_h, stress, &loads);
    Estimate                      result;
    result.indicators = stress_difference(
      u_h.mesh(),
      stress,
      [&](const unsigned int       cell,
          const mesh::Barycentric &b,
          const dealii::Point<3> &,
          double *s) { averages.at(cell, b, s); },
      compare::tet_quadrature(u_h.degree() == 1 ? 2 : 5),
      input.comparison.mpi_communicator());
    result.global = compare::root_of_squares(result.indicators);
    return result;
  }
} // namespace tetradapt::estimate
