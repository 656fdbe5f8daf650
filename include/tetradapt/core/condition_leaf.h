// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_condition_leaf_h
#define tetradapt_core_condition_leaf_h

#include "tetradapt/core/expression.h"

#include <optional>

namespace tetradapt::core
{
  /**
   * An elementary part of a condition: a comparison or one side of a selector, with
   * a function of the point whose sign tells where it holds.
   *
   * level() is negative where the leaf holds, positive where it does not. On its
   * border it is zero; includes_border says whether the leaf holds there.
   */
  struct ConditionLeaf
  {
    enum class Kind
    {
      affine,   ///< level is normal . p - offset, a distance: |normal| = 1
      sphere,   ///< level is |p - center| - radius
      cylinder, ///< level is the distance from the axis through center along normal - radius
      general,  ///< level is the difference of two expressions
      truth,    ///< level is -1 or 1
      constant  ///< the same everywhere
    };

    Kind         kind = Kind::constant;
    std::string  text; ///< as a message may quote it
    bool         includes_border = true;
    Tensor<1, 3> normal;
    double       offset = 0.; ///< of a constant: its level
    Point<3>     center;
    double       radius = 0.;

    /** For general: the level. */
    std::optional<Expression> difference;
    /** For general and truth: 1 where the leaf holds, else 0. */
    std::optional<Expression> truth;

    /** Where the difference has no finite value, general leaves say -1 or 1 after the
     * comparison itself. @throws InputError as Expression does. */
    double
    level(const Point<3> &point, double t = 0.) const;
  };
} // namespace tetradapt::core

#endif
