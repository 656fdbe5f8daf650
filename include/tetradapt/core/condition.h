// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_condition_h
#define tetradapt_core_condition_h

#include "tetradapt/core/condition_leaf.h"

#include <vector>

namespace tetradapt::core
{
  /** How the leaves of a condition are combined: a tree. */
  struct ConditionNode
  {
    enum class Kind
    {
      leaf,
      all,     ///< and
      any,     ///< or
      negation ///< not, of one child
    };
    Kind                       kind = Kind::leaf;
    unsigned int               leaf = 0; ///< its number, for a leaf
    std::vector<ConditionNode> children;
  };

  /**
   * A condition on x, y, z, given as text: an expression (see core::Expression) that
   * is true or false, 1 or 0.
   *
   * Comparisons and the selectors box, sphere, cylinder and half_space, combined by
   * &&, ||, !, if(,,), c ? a : b and brackets, are taken apart into leaves, so that
   * the border of the set where the condition holds is known. abs, min and max as a
   * whole side of a comparison become several leaves: abs(x) < .25 is x < .25 and
   * -x < .25. What else gives 0 or 1 is one leaf that has no level.
   */
  class Condition
  {
  public:
    /**
     * @param what names the place in messages, for example "Supports/base/Where".
     * @throws InputError saying what was probably meant, if the text is no expression,
     *         is a number instead of a condition as far as its structure shows it, or
     *         depends on t although not @p time_allowed.
     */
    Condition(const std::string &text, const std::string &what, bool time_allowed = false);

    /** @throws InputError if the value at @p point is neither 0 nor 1. */
    bool
    holds(const Point<3> &point, double t = 0.) const;

    /** Its elementary parts; the same comparison twice is two of them. */
    const std::vector<ConditionLeaf> &
    leaves() const
    {
      return all_leaves;
    }

    /** Whether the condition holds where the leaves do for which @p leaf_holds, one
     * entry a leaf, says so. */
    bool
    combine(const std::vector<bool> &leaf_holds) const;

    /** Whether it is the same at all points and times. */
    bool
    is_constant() const
    {
      return expression.is_constant();
    }

    const std::string &
    text() const
    {
      return expression.text();
    }

  private:
    Expression                 expression;
    std::string                what;
    std::vector<ConditionLeaf> all_leaves;
    ConditionNode              root;
  };
} // namespace tetradapt::core

#endif
