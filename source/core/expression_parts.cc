// SPDX-License-Identifier: AGPL-3.0-or-later
#include "expression_parts.h"

namespace tetradapt::core
{
  using Kind = ExpressionToken::Kind;

  namespace
  {
    /** The token that closes the bracket @p open. */
    std::size_t
    closing(const Tokens &tokens, const std::size_t open)
    {
      unsigned int depth = 0;
      for (std::size_t i = open; i < tokens.size(); ++i)
        if (tokens[i].kind == Kind::open)
          ++depth;
        else if (tokens[i].kind == Kind::close && --depth == 0)
          return i;
      return tokens.size();
    }
  } // namespace

  std::vector<std::size_t>
  outside_brackets(const Tokens &tokens, const std::function<bool(const ExpressionToken &)> &wanted)
  {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < tokens.size(); ++i)
      if (tokens[i].kind == Kind::open)
        i = closing(tokens, i);
      else if (wanted(tokens[i]))
        found.push_back(i);
    return found;
  }

  std::vector<std::size_t>
  outside_brackets(const Tokens &tokens, const char *symbol)
  {
    return outside_brackets(tokens, [&](const ExpressionToken &t) { return t.is(symbol); });
  }

  std::string
  part(const std::string &text, const Tokens &tokens, std::size_t begin, std::size_t end)
  {
    if (begin >= end)
      return "";
    const ExpressionToken &last = tokens[end - 1];
    return text.substr(tokens[begin].position,
                       last.position + last.text.size() - tokens[begin].position);
  }

  std::vector<std::string>
  pieces(const std::string &text, const Tokens &tokens, const std::vector<std::size_t> &at)
  {
    std::vector<std::string> result;
    std::size_t              begin = 0;
    for (const std::size_t cut : at)
      {
        result.push_back(part(text, tokens, begin, cut));
        begin = cut + 1;
      }
    result.push_back(part(text, tokens, begin, tokens.size()));
    return result;
  }

  bool
  in_brackets(const Tokens &tokens)
  {
    return !tokens.empty() && tokens[0].kind == Kind::open
           && closing(tokens, 0) + 1 == tokens.size();
  }

  bool
  is_call(const Tokens &tokens)
  {
    return tokens.size() > 2 && tokens[0].kind == Kind::name && tokens[1].kind == Kind::open
           && closing(tokens, 1) + 1 == tokens.size();
  }

  std::string
  bare(std::string text)
  {
    for (Tokens tokens = expression_tokens(text); in_brackets(tokens);
         tokens        = expression_tokens(text))
      text = part(text, tokens, 1, tokens.size() - 1);
    return text;
  }

  std::vector<std::string>
  arguments_of(const std::string &text)
  {
    const Tokens      tokens = expression_tokens(text);
    const std::string inside = part(text, tokens, 2, tokens.size() - 1);
    const Tokens      inner  = expression_tokens(inside);
    return pieces(inside, inner, outside_brackets(inner, ","));
  }

  bool
  is_call_of(const std::string &text, const char *name)
  {
    const Tokens tokens = expression_tokens(text);
    return is_call(tokens) && tokens[0].is(name);
  }
} // namespace tetradapt::core
