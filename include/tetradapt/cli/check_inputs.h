// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_check_inputs_h
#define tetradapt_cli_check_inputs_h

#include "tetradapt/scene/scene.h"

namespace tetradapt::cli
{
  /**
   * Reads the files that a scene names and checks what needs no mesh generator:
   * that volume meshes and surfaces are sound (also the surface to project on and the
   * reference's mesh), that a size field has sizes and an earlier run a displacement, and,
   * where the first mesh is given (bricks, or a file that is not refined), that supports,
   * loads and materials find their faces and regions there.
   *
   * @throws core::InputError as a run would.
   */
  void
  check_inputs(const scene::Scene &scene);
} // namespace tetradapt::cli

#endif
