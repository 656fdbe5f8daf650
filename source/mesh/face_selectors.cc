// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/face_selectors.h"

namespace tetradapt::mesh
{
  std::vector<std::pair<std::string, scene::Selector>>
  face_selectors(const scene::Scene &scene)
  {
    std::vector<std::pair<std::string, scene::Selector>> selectors;
    for (const auto &support : scene.supports)
      if (!support.place.is_set())
        selectors.emplace_back("Supports/" + support.name, support.selector);
    for (const auto &load : scene.loads)
      if (scene::acts_on_faces(load.type))
        selectors.emplace_back("Loads/" + load.name, load.selector);
    for (const auto &goal : scene.goals)
      if (goal.uses_faces() && !goal.selector.empty())
        selectors.emplace_back("Goals/" + goal.name, goal.selector);
    return selectors;
  }
} // namespace tetradapt::mesh
