// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_recovery_stress_samples_h
#define tetradapt_estimate_recovery_stress_samples_h

#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/estimate/cell_stress.h"

namespace tetradapt::estimate
{
  /** The stresses of a solution at the same few points of every cell. */
  class StressSamples
  {
  public:
    /** What a sample consists of: x, y, z and six stresses. */
    static constexpr unsigned int n_numbers = 9;

    /** At the points of @p rule. */
    StressSamples(const mesh::TetMesh          &mesh,
                  const CellStress             &stress,
                  const compare::TetQuadrature &rule);

    unsigned int
    n_a_cell() const
    {
      return n_points;
    }

    /** The samples of @p cell: number k of point q is [k n_a_cell() + q]. */
    const double *
    operator[](const unsigned int cell) const
    {
      return &values[std::size_t(cell) * (n_numbers * n_points)];
    }

  private:
    unsigned int        n_points;
    std::vector<double> values;
  };
} // namespace tetradapt::estimate

#endif
