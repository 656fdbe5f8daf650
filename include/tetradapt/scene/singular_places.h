// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_singular_places_h
#define tetradapt_scene_singular_places_h

#include "tetradapt/scene/scene.h"

namespace tetradapt::scene
{
  /** The first support at a point or on a line, or the first point force: "Loads/tip"; empty if
   * the scene has none. */
  std::string
  first_place(const Scene &scene);

  /** The same of those whose energy is to be taken for infinite: point forces, and supports
   * unless the user says by Excluded radius = 0 that they carry nothing. */
  std::string
  first_singular_place(const Scene &scene);
} // namespace tetradapt::scene

#endif
