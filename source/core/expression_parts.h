// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_expression_parts_h
#define tetradapt_core_expression_parts_h

#include "tetradapt/core/expression_tokens.h"

#include <functional>

/** Functions that cut the text of an expression at its brackets and operators. */
namespace tetradapt::core
{
  using Tokens = std::vector<ExpressionToken>;

  /** The numbers of the tokens outside all brackets for which @p wanted holds. */
  std::vector<std::size_t>
  outside_brackets(const Tokens                                       &tokens,
                   const std::function<bool(const ExpressionToken &)> &wanted);

  /** The same for the operator @p symbol. */
  std::vector<std::size_t>
  outside_brackets(const Tokens &tokens, const char *symbol);

  /** The text from token @p begin up to before token @p end. */
  std::string
  part(const std::string &text, const Tokens &tokens, std::size_t begin, std::size_t end);

  /** @p text without the tokens @p at, in the pieces between them. */
  std::vector<std::string>
  pieces(const std::string &text, const Tokens &tokens, const std::vector<std::size_t> &at);

  /** Whether one pair of brackets is around all. */
  bool
  in_brackets(const Tokens &tokens);

  /** Whether all is one call of a function. */
  bool
  is_call(const Tokens &tokens);

  /** Whether all is one call of the function @p name. */
  bool
  is_call_of(const std::string &text, const char *name);

  /** @p text without brackets around all of it. */
  std::string
  bare(std::string text);

  /** The arguments of the call that @p text is. */
  std::vector<std::string>
  arguments_of(const std::string &text);
} // namespace tetradapt::core

#endif
