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
   */
  RecoveryEstimate recovery_estimate(const mesh::NodalField       &u_h,
                                     const mechanics::MaterialMap &materials,
                                     MPI_Comm                      communicator);
} // namespace tetradapt::compare

#endif
