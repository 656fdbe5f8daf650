// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/moved_supports.h"

#include "tetradapt/core/expression.h"

namespace tetradapt::scene
{
  bool
  moves_supports(const Scene &scene)
  {
    for (const auto &support : scene.supports)
      for (unsigned int i = 0; i < 3; ++i)
        if (support.components[i])
          {
            const core::Expression value(support.displacement[i],
                                         "Supports/" + support.name + "/Displacement");
            if (!value.is_constant() || value(core::Point<3>()) != 0.)
              return true;
          }
    return false;
  }
} // namespace tetradapt::scene
