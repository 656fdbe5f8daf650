// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/polynomial_text.h"

#include "tetradapt/core/expression_tokens.h"

#include <algorithm>
#include <cstdlib>

namespace tetradapt::core
{
  namespace
  {
    bool
    is_variable(const std::string &name)
    {
      static const char *const names[] = {"x", "y", "z", "nx", "ny", "nz"};
      return std::find(std::begin(names), std::end(names), name) != std::end(names);
    }

    bool
    is_constant_name(const std::string &name)
    {
      return name == "pi" || name == "e" || name == "_pi" || name == "_e";
    }

    /** A whole number from 0 to 8, or -1. */
    int
    exponent(const ExpressionToken &token)
    {
      if (token.kind != ExpressionToken::Kind::number)
        return -1;
      const double value = std::strtod(token.text.c_str(), nullptr);
      return value >= 0. && value <= 8. && value == static_cast<int>(value)
               ? static_cast<int>(value)
               : -1;
    }

    /** A bound of the degree of what is_polynomial() accepts is the number of variables, each
     * with its exponent. */
    constexpr int largest_degree = 16;
  } // namespace

  bool
  is_polynomial(const std::string &text)
  {
    using Kind        = ExpressionToken::Kind;
    const auto tokens = expression_tokens(text);
    int        degree = 0;
    for (std::size_t i = 0; i < tokens.size(); ++i)
      {
        const ExpressionToken &token = tokens[i];
        const bool             last  = i + 1 == tokens.size();
        switch (token.kind)
          {
          case Kind::number:
          case Kind::open:
          case Kind::close:
            break;
          case Kind::name:
            if (!is_variable(token.text) && !is_constant_name(token.text))
              return false;
            degree += is_variable(token.text);
            break;
          case Kind::symbol:
            if (token.is("+") || token.is("-") || token.is("*"))
              break;
            if (last)
              return false;
            // Only of a variable or a number: powers of brackets may nest to any degree. They are
            // taken from the right, so that a second one would make a tower.
            if (token.is("^") && i > 0
                && (tokens[i - 1].kind == Kind::name || tokens[i - 1].kind == Kind::number)
                && exponent(tokens[i + 1]) >= 0
                && !(i + 2 < tokens.size() && tokens[i + 2].is("^")))
              {
                if (is_variable(tokens[i - 1].text))
                  degree += exponent(tokens[i + 1]) - 1;
                break;
              }
            if (token.is("/")
                && (tokens[i + 1].kind == Kind::number
                    || (tokens[i + 1].kind == Kind::name && is_constant_name(tokens[i + 1].text)))
                && !(i + 2 < tokens.size() && tokens[i + 2].is("^")))
              break;
            return false;
          case Kind::comma:
          case Kind::comparison:
          case Kind::logical:
            return false;
          }
      }
    return !tokens.empty() && degree <= largest_degree;
  }
} // namespace tetradapt::core
