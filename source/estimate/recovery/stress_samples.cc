// SPDX-License-Identifier: AGPL-3.0-or-later
#include "stress_samples.h"

#include "tetradapt/compare/field_evaluator.h"

namespace tetradapt::estimate
{
  StressSamples::StressSamples(const mesh::TetMesh          &mesh,
                               const CellStress             &stress,
                               const compare::TetQuadrature &rule)
    : n_points(rule.points.size()), values(std::size_t(mesh.n_cells()) * n_numbers * n_points)
  {
    double *sample = values.data();
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell, sample += n_numbers * n_points)
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const Point<3> point = compare::position(mesh, cell, rule.points[q]);
          double         s[6];
          stress.at(cell, rule.points[q], point, s);
          for (unsigned int d = 0; d < 3; ++d)
            sample[d * n_points + q] = point[d];
          for (unsigned int a = 0; a < 6; ++a)
            sample[(3 + a) * n_points + q] = s[a];
        }
  }
} // namespace tetradapt::estimate
