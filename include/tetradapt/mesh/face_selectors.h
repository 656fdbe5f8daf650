// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_face_selectors_h
#define tetradapt_mesh_face_selectors_h

#include "tetradapt/scene/scene.h"

#include <string>
#include <utility>
#include <vector>

namespace tetradapt::mesh
{
  /** The selectors of the scene's supports and face loads, by name. */
  std::vector<std::pair<std::string, scene::Selector>>
  face_selectors(const scene::Scene &scene);
} // namespace tetradapt::mesh

#endif
