// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_recovery_h
#define tetradapt_compare_recovery_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/nodal_field.h"

#include <mpi.h>

namespace tetradapt::compare
{
  /** A recovered-stress estimate of the error of a solution. */
  struct RecoveryEstimate
  {
    std::vector<double> cell_energy; ///< eta_K, energy norm, one a cell
    double              global = 0.; ///< square root of the sum of squares
  };

  /**
   * Zienkiewicz-Zhu estimate with superconvergent patch recovery (IJNME 33,
   * 1992): around every vertex, and separately in each region that meets there,
   * a polynomial of the field's degree is fitted to the stresses at the cells'
   * superconvergent points (degree 1: centroids; degree 2: the four Gauss points);
   * in a cell the patches of its vertices are blended by the barycentric
   * coordinates. eta_K^2 = int_K (s*-s_h):C^-1:(s*-s_h). Collective.
   *
   * The stress is the law's at the displacement gradient minus the thermal
   * strain. A patch with less than twice as many points as coefficients, or whose
   * points determine the polynomial badly (in corners, in layers of one cell), is
   * enlarged by the patches of its cells' vertices, twice at most; where that
   * does not help, the polynomial's degree is lowered. The integral is taken with
   * 4 points for degree 1 and with 14 for degree 2: at the four Gauss points,
   * where the stresses were taken, s*-s_h is far smaller than elsewhere.
   */
  RecoveryEstimate
  recovery_estimate(const mesh::NodalField       &u_h,
                    const mechanics::MaterialMap &materials,
                    MPI_Comm                      communicator);
} // namespace tetradapt::compare

#endif
