// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_reference_maker_h
#define tetradapt_adapt_reference_maker_h

#include "tetradapt/compare/reference.h"
#include "tetradapt/core/log.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::adapt
{
  /**
   * Solves, or reads from the cache, or reads from an earlier run's .vtu, the
   * scene's reference. Collective.
   *
   * @param initial_mesh the scene's initial mesh with selections made; the route
   *        "refine" refines it; on hexahedra supports and loads act where they act on it.
   * @param excluded what its own error leaves out.
   */
  compare::Reference
  make_reference(const scene::Scene            &scene,
                 const mechanics::MaterialMap  &materials,
                 const mesh::TetMesh           &initial_mesh,
                 MPI_Comm                       communicator,
                 const core::Log               &log,
                 const compare::ExcludedRegion &excluded = {});
} // namespace tetradapt::adapt

#endif
