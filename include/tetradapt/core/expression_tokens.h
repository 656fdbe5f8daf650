// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_expression_tokens_h
#define tetradapt_core_expression_tokens_h

#include <string>
#include <vector>

namespace tetradapt::core
{
  /** A word of an expression: a number, a name, an operator, a bracket or a comma. */
  struct ExpressionToken
  {
    enum class Kind
    {
      number,
      name,
      open,
      close,
      comma,
      comparison, ///< <, <=, >, >=, ==, !=
      logical,    ///< &&, ||, ?, :
      symbol      ///< all else, arithmetic and what nobody knows
    };
    Kind        kind;
    std::string text;
    std::size_t position; ///< of its first character in the expression

    bool
    is(const char *symbol) const
    {
      return text == symbol;
    }
  };

  /** The words of @p text. Never throws: what is no word is a symbol of one character. */
  std::vector<ExpressionToken>
  expression_tokens(const std::string &text);

  /**
   * The number of arguments, without the point, of a selector that expressions
   * know: box 6, sphere 4, cylinder 7, half_space 6; 0 for any other name.
   */
  unsigned int
  selector_arguments(const std::string &name);

  /**
   * Refuses what muParser reads as something else than people mean by it, or
   * reports in its own words.
   * @param what names the place in messages.
   * @throws InputError saying what was probably meant, for a lone = (which assigns),
   *         =<, =>, a chained comparison, a single & or |, the words and, or, not,
   *         a selector with a wrong number of arguments.
   */
  void
  check_expression_syntax(const std::string &text, const std::string &what);

  /** @p text with the point x,y,z as the first arguments of each selector, as the
   * functions behind them take it. */
  std::string
  with_selector_points(const std::string &text);
} // namespace tetradapt::core

#endif
