// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_recovery_difference_h
#define tetradapt_estimate_recovery_difference_h

#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/core/lanes.h"
#include "tetradapt/estimate/recovery/recovery.h"

namespace tetradapt::estimate
{
  /**
   * The integral of the complementary energy density of s* - s_h over one cell after the
   * other, s* the RecoveredStress and s_h linear or constant. All points of the rule are
   * worked on together, a lane of the processor's vectors each.
   */
  class RecoveryDifference
  {
  public:
    /**
     * Keeps references.
     * @param stress without thermal strain.
     * @param rule with at most 16 points; more throw std::invalid_argument.
     */
    RecoveryDifference(const mesh::TetMesh          &mesh,
                       const CellStress             &stress,
                       const RecoveredStress        &recovered,
                       const compare::TetQuadrature &rule);

    /** The root of the integral over @p cell. */
    double
    operator()(unsigned int cell) const;

    static constexpr unsigned int n_vectors = 2;

    /** The rule, filled up with points of no weight. */
    struct Rule
    {
      alignas(64) core::Lanes barycentric[4][n_vectors];
      alignas(64) core::Lanes weights[n_vectors];
    };

    /** A cell in plain numbers. */
    struct Cell
    {
      double        corners[4][3];
      const double *polynomials[4]; ///< of the corners' patches, see RecoveredStress
      double        stress[4][6];   ///< s_h at the corners
      const double *compliance;     ///< 6 x 6
    };

  private:
    const mesh::TetMesh   &mesh;
    const CellStress      &stress;
    const RecoveredStress &recovered;
    bool                   linear; ///< polynomials, else quadratic
    Rule                   lanes;
  };
} // namespace tetradapt::estimate

#endif
