// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_stress_difference_h
#define tetradapt_estimate_stress_difference_h

#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/compare/parallel.h"
#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/core/failure.h"
#include "tetradapt/estimate/cell_stress.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  /** stress_difference() in one cell. */
  template <typename Stress>
  double
  stress_difference_in(const mesh::TetMesh          &mesh,
                       const CellStress             &stress,
                       const Stress                 &better,
                       const compare::TetQuadrature &rule,
                       const unsigned int            cell)
  {
    const ElasticMatrices &matrices = stress.materials()[cell];
    double                 sum      = 0.;
    for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        const Point<3> point = compare::position(mesh, cell, rule.points[q]);
        double         s[6], difference[6];
        stress.at(cell, rule.points[q], point, s);
        better(cell, rule.points[q], point, difference);
        for (unsigned int c = 0; c < 6; ++c)
          difference[c] -= s[c];
        sum += rule.weights[q] * matrices.complementary_density(difference);
      }
    return std::sqrt(std::max(sum, 0.) * mesh::cell_volume(mesh, cell));
  }

  /**
   * The energy norm of the difference between a better stress and that of a solution,
   * the root of int_K (s* - s_h) : C^-1 : (s* - s_h), for every cell. Collective.
   *
   * @param better gives s* at a point: better(cell, barycentric, point, stress).
   * @param rule for the integral.
   */
  template <typename Stress>
  std::vector<double>
  stress_difference(const mesh::TetMesh          &mesh,
                    const CellStress             &stress,
                    const Stress                 &better,
                    const compare::TetQuadrature &rule,
                    const MPI_Comm                communicator)
  {
    std::vector<double> result(mesh.n_cells(), 0.);
    core::together(communicator, [&] {
      const compare::Slice slice = compare::own_slice(mesh.n_cells(), communicator);
      for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
        result[cell] = stress_difference_in(mesh, stress, better, rule, cell);
    });
    compare::gather_slices(result, mesh.n_cells(), 1, communicator);
    return result;
  }
} // namespace tetradapt::estimate

#endif
