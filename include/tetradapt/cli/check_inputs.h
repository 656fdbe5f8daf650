// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_check_inputs_h
#define tetradapt_cli_check_inputs_h

#include "tetradapt/core/log.h"
#include "tetradapt/scene/mistakes.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::cli
{
  /**
   * Reads the files that a scene names and checks what needs no mesh generator:
   *
   * - that volume meshes and surfaces are sound (also the surface to project on and the
   *   reference's mesh), that a size field has sizes and an earlier run a displacement;
   * - that boundary ids, groups, regions and region groups of materials, supports, loads and goals
   *   are those of the body;
   * - that conditions are true or false at points all over its surface;
   * - where a mesh is given (bricks, or a file that is not refined), that selections find faces on
   *   it, and what adapt::check_placement() checks. On other bodies a condition that holds at none
   *   of the points is warned of in @p log.
   *
   * @param mistakes gets what is wrong, in the words of a run.
   */
  void
  check_inputs(const scene::Scene &scene, scene::Mistakes &mistakes, const core::Log &log);
} // namespace tetradapt::cli

#endif
