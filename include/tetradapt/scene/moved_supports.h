// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_moved_supports_h
#define tetradapt_scene_moved_supports_h

#include "tetradapt/scene/scene.h"

namespace tetradapt::scene
{
  /** Whether a support of @p scene prescribes a displacement other than zero. */
  bool
  moves_supports(const Scene &scene);

  /** Whether a force or a moment acts at the reference point of a rigid support of @p scene. */
  bool
  loads_supports(const Scene &scene);
} // namespace tetradapt::scene

#endif
