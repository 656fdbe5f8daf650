// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_mean_stresses_h
#define tetradapt_report_mean_stresses_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/nodal_field.h"

#include <array>
#include <string>
#include <vector>

namespace tetradapt::report
{
  /** Names of the components of MeanStresses::stress, in order. */
  extern const std::array<const char *, 6> stress_component_names;

  /** Mean stresses of cells, pressure unit of the scene. */
  struct MeanStresses
  {
    /** Six numbers a cell: xx, yy, zz, xy, yz, xz (ParaView's order). */
    std::vector<double> stress;
    /** von Mises stress of the mean stress, one a cell:
     * sqrt(3/2 s:s) with s the deviator. */
    std::vector<double> von_mises;
    /** Minus a third of the trace of the mean stress, one a cell. */
    std::vector<double> pressure;
  };

  /**
   * The mean stress of every cell, thermal strain taken off:
   * sigma(G) - C(G):eps_th. The mean is exact for a linear law, where it is the
   * stress at the centroid, and otherwise taken with the four points of the rule
   * of degree 2. The thermal strain is averaged with that rule. Of a solution in mixed form it
   * is the mean of 2 mu (eps - eps_th) - p I.
   */
  MeanStresses
  mean_stresses(const mesh::NodalField &u, const mechanics::MaterialMap &materials);
} // namespace tetradapt::report

#endif
