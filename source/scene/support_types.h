// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_support_types_h
#define tetradapt_scene_support_types_h

#include "binder.h"

#include "tetradapt/scene/mistakes.h"
#include "tetradapt/scene/model_parameters.h"

namespace tetradapt::scene
{
  /** Declares or reads the type of a support. */
  void
  bind_support_type(SupportParameters &support, Binder &binder);

  /** Declares or reads what sliding and rigid supports have in addition to fixed ones. */
  void
  bind_special_support(SupportParameters &support, Binder &binder);

  /** Adds what is wrong with a sliding or a rigid support by itself, and parameters of these in
   * supports of other types. */
  void
  check_special_support(const SupportParameters &support, Mistakes &mistakes);

  /** Whether @p support may hold component @p c of the displacement somewhere. */
  bool
  may_hold(const SupportParameters &support, unsigned int c);
} // namespace tetradapt::scene

#endif
