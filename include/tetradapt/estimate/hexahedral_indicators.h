// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_hexahedral_indicators_h
#define tetradapt_estimate_hexahedral_indicators_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/solve/hexahedral_space.h"

namespace tetradapt::estimate
{
  /**
   * Indicators of the energy error of a displacement on hexahedra: in each own cell the
   * root of int (s*-s_h) : C^-1 : (s*-s_h), where s* is continuous within each region
   * and has at the nodes the mean of the stresses of the cells around (Zienkiewicz and
   * Zhu, IJNME 24, 1987). They tell where the error is, not how large. Collective.
   *
   * @param displacement has its values at hanging nodes too. Its layout has the unknowns of own
   *        cells, and what these depend on.
   */
  std::vector<double>
  hexahedral_indicators(const solve::HexahedralSpace &space,
                        const mechanics::MaterialMap &materials,
                        const solve::Vector          &displacement);
} // namespace tetradapt::estimate

#endif
