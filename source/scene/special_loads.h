// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_special_loads_h
#define tetradapt_scene_special_loads_h

#include "binder.h"

#include "tetradapt/scene/mistakes.h"
#include "tetradapt/scene/model_parameters.h"

namespace tetradapt::scene
{
  /** Declares or reads what total forces and rotations have in addition to other loads. */
  void
  bind_special_loads(LoadParameters &load, Binder &binder);

  /** Adds what is wrong with a total force or a rotation, and parameters of these in loads of
   * other types. */
  void
  check_special_load(const LoadParameters &load, Mistakes &mistakes);

  /** The parameter that would have to be other than zero for the load to do something, such as
   * "Value"; empty: it does something, as far as the load itself tells. */
  std::string
  zero_parameter(const LoadParameters &load);
} // namespace tetradapt::scene

#endif
