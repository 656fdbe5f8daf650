// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/singular_places.h"

namespace tetradapt::scene
{
  std::string
  first_place(const Scene &scene)
  {
    for (const auto &load : scene.loads)
      if (load.place.is_set())
        return "Loads/" + load.name;
    for (const auto &support : scene.supports)
      if (support.place.is_set())
        return "Supports/" + support.name;
    return "";
  }

  std::string
  first_singular_place(const Scene &scene)
  {
    for (const auto &load : scene.loads)
      if (load.place.is_set())
        return "Loads/" + load.name;
    for (const auto &support : scene.supports)
      if (support.place.excludes())
        return "Supports/" + support.name;
    return "";
  }
} // namespace tetradapt::scene
