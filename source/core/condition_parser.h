// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_condition_parser_h
#define tetradapt_core_condition_parser_h

#include "tetradapt/core/condition.h"
#include "tetradapt/core/expression_tokens.h"

namespace tetradapt::core
{
  /** Takes a condition apart (see Condition); collects its leaves. */
  class ConditionParser
  {
  public:
    explicit ConditionParser(const std::string &what);

    /** @p text must be an expression that core::Expression reads. */
    ConditionNode
    parse(const std::string &text);

    /** Those of all conditions parsed so far. */
    std::vector<ConditionLeaf>
    take_leaves()
    {
      return std::move(leaves);
    }

  private:
    ConditionNode
    parse_choice(const std::string &condition, const std::string &yes, const std::string &no);

    ConditionNode
    parse_negation(const std::string &text, const std::vector<ExpressionToken> &tokens);

    /** A comparison, a selector, a function of conditions, or a number. */
    ConditionNode
    parse_item(const std::string &text, const std::vector<ExpressionToken> &tokens);

    /** @p left @p sign @p right, where the sign is < or <=. */
    ConditionNode
    less(const std::string &left, const std::string &sign, const std::string &right);

    ConditionNode
    parse_selector(const std::string &text, const std::vector<std::string> &arguments);

    ConditionNode
    number_or_truth(const std::string &text, const std::vector<ExpressionToken> &tokens);

    ConditionNode
    add(ConditionLeaf leaf);

    /** A half space whose @p normal need not have the length 1. */
    ConditionNode
    add_plane(const Tensor<1, 3> &normal,
              double              offset,
              bool                includes_border,
              const std::string  &text);

    std::string                what;
    std::vector<ConditionLeaf> leaves;
  };
} // namespace tetradapt::core

#endif
