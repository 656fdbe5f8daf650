// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_place_choice_h
#define tetradapt_scene_place_choice_h

#include "tetradapt/scene/scene.h"

namespace tetradapt::scene
{
  class Binder;

  /** Binds Point, Line and Excluded radius, of which loads have no Line. */
  void
  bind_place(PlaceParameters &place, bool has_line, Binder &binder);

  /**
   * Checks a point or a line that is set, and that nothing else selects.
   * @param path full name of the block, "Supports/hinge".
   * @throws InputError, or SeveralMistakes.
   */
  void
  check_place(const PlaceParameters &place, const Selector &selector, const std::string &path);

  /**
   * Checks that what a scene with forces or supports at points or on lines asks for means something
   * although energies do not converge there.
   * @throws InputError, or SeveralMistakes.
   */
  void
  check_point_conditions(const Scene &scene);
} // namespace tetradapt::scene

#endif
