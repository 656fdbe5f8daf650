// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/moved_supports.h"

#include "tetradapt/core/expression.h"

#include <algorithm>

namespace tetradapt::scene
{
  namespace
  {
    bool
    is_zero(const std::string &text, const std::string &what)
    {
      const core::Expression value(text, what);
      return value.is_constant() && value(core::Point<3>()) == 0.;
    }

    bool
    moves(const RigidParameters::Motion &motion)
    {
      return std::any_of(motion.begin(), motion.end(), [](const auto &component) {
        return component.value_or(0.) != 0.;
      });
    }

    bool
    moves(const SupportParameters &support)
    {
      const std::string path = "Supports/" + support.name;
      if (support.type == SupportType::sliding)
        return !is_zero(support.normal_displacement, path + "/Normal displacement");
      if (support.type == SupportType::rigid)
        return moves(support.rigid.translation) || moves(support.rigid.rotation);
      for (unsigned int i = 0; i < 3; ++i)
        if ((support.components[i] || support.type == SupportType::spring)
            && !is_zero(support.displacement[i], path + "/Displacement"))
          return true;
      return false;
    }
  } // namespace

  bool
  moves_supports(const Scene &scene)
  {
    return std::any_of(scene.supports.begin(), scene.supports.end(), [](const auto &support) {
      return moves(support);
    });
  }
} // namespace tetradapt::scene
