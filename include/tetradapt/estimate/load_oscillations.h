// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_load_oscillations_h
#define tetradapt_estimate_load_oscillations_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/nodal_field.h"
#include "tetradapt/scene/scene.h"

#include <mpi.h>

#include <vector>

namespace tetradapt::estimate
{
  /**
   * What no estimator sees of the loads: for each cell an energy norm that the part of the
   * body force, the tractions on its faces and the thermal strain can cause which is no
   * quadratic polynomial there, see load_oscillation(). It is added to the indicators that drive
   * refinement, so that peaks and jumps of loads are resolved.
   *
   * @return one a cell; empty if no load varies. Collective.
   */
  std::vector<double>
  load_oscillations(const mesh::NodalField       &u_h,
                    const scene::Scene           &scene,
                    const mechanics::MaterialMap &materials,
                    MPI_Comm                      communicator);
} // namespace tetradapt::estimate

#endif
