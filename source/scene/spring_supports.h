// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_spring_supports_h
#define tetradapt_scene_spring_supports_h

#include "tetradapt/scene/mistakes.h"
#include "tetradapt/scene/scene.h"

#include "binder.h"

namespace tetradapt::scene
{
  /** Binds what only supports of type spring have, when everything else is bound.
   * @param components what Components was bound to; springs prescribe none.
   * @throws core::InputError for Components of a spring. */
  void
  bind_spring(SupportParameters &support, const std::array<bool, 3> &components, Binder &binder);

  /** Checks them, and that no other support has them. */
  void
  check_spring(const SupportParameters &support, Mistakes &mistakes);

  /** Refuses by name what springs cannot be together with.
   * @throws core::InputError */
  void
  check_spring_supports(const Scene &scene);
} // namespace tetradapt::scene

#endif
