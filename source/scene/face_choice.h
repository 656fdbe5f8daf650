// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_face_choice_h
#define tetradapt_scene_face_choice_h

#include "tetradapt/scene/model_parameters.h"

namespace tetradapt::scene
{
  class Binder;

  /** Binds the parameter Where. */
  void
  bind_where(Selector &selector, Binder &binder);

  /**
   * Checks what chooses the faces of a support, a load or a goal.
   * @param path full name of the block, "Loads/tip".
   * @throws InputError if nothing is chosen, or if the condition is none or holds nowhere.
   */
  void
  check_faces(const Selector &selector, const std::string &path);
} // namespace tetradapt::scene

#endif
