// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/expression_tokens.h"

#include "tetradapt/core/exceptions.h"

#include <cctype>

namespace tetradapt::core
{
  namespace
  {
    using Token  = ExpressionToken;
    using Tokens = std::vector<Token>;
    using Kind   = ExpressionToken::Kind;

    bool
    is_digit(const char c)
    {
      return std::isdigit(static_cast<unsigned char>(c)) != 0;
    }

    bool
    is_letter(const char c)
    {
      return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    }

    /** Past the number that begins at @p i. */
    std::size_t
    end_of_number(const std::string &text, std::size_t i)
    {
      while (i < text.size() && (is_digit(text[i]) || text[i] == '.'))
        ++i;
      if (i < text.size() && (text[i] == 'e' || text[i] == 'E'))
        {
          std::size_t exponent = i + 1;
          if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-'))
            ++exponent;
          if (exponent < text.size() && is_digit(text[exponent]))
            {
              i = exponent;
              while (i < text.size() && is_digit(text[i]))
                ++i;
            }
        }
      return i;
    }

    Kind
    kind_of_symbol(const std::string &symbol)
    {
      if (symbol == "(")
        return Kind::open;
      if (symbol == ")")
        return Kind::close;
      if (symbol == ",")
        return Kind::comma;
      if (symbol == "<" || symbol == "<=" || symbol == ">" || symbol == ">=" || symbol == "=="
          || symbol == "!=")
        return Kind::comparison;
      if (symbol == "&&" || symbol == "||" || symbol == "?" || symbol == ":")
        return Kind::logical;
      return Kind::symbol;
    }

    [[noreturn]] void
    refuse(const std::string &what, const std::string &text, const std::string &why)
    {
      throw InputError(what + ": the expression '" + text + "' cannot be used: " + why);
    }

    /** The source between the tokens @p begin and @p end. */
    std::string
    source(const std::string &text, const Tokens &tokens, std::size_t begin, std::size_t end)
    {
      if (begin >= end)
        return "";
      return text.substr(tokens[begin].position,
                         tokens[end - 1].position + tokens[end - 1].text.size()
                           - tokens[begin].position);
    }

    void
    check_words(const std::string &text, const std::string &what, const Tokens &tokens)
    {
      for (const Token &token : tokens)
        {
          if (token.is("="))
            refuse(what,
                   text,
                   "a single = assigns a value, it does not compare. Write == for equal; with "
                   "room for rounding, abs(a - b) < 1e-9.");
          if (token.is("=<") || token.is("=>"))
            refuse(what,
                   text,
                   std::string("write ") + (token.is("=<") ? "<=" : ">=") + " for " + token.text
                     + ".");
          if (token.is("&") || token.is("|"))
            refuse(what,
                   text,
                   "write " + token.text + token.text + " for " + (token.is("&") ? "and" : "or")
                     + ".");
          if (token.is("and") || token.is("or") || token.is("not"))
            refuse(what,
                   text,
                   std::string("write ")
                     + (token.is("and")  ? "&&"
                        : token.is("or") ? "||"
                                         : "!")
                     + " for '" + token.text + "'.");
        }
    }

    /** Finds comparisons that share an operand, one level of brackets at a time. */
    class ChainCheck
    {
    public:
      ChainCheck(const std::string &text, const std::string &what, const Tokens &tokens)
        : text(text), what(what), tokens(tokens)
      {
      }

      void
      run()
      {
        levels.push_back({0, {}});
        for (std::size_t i = 0; i < tokens.size(); ++i)
          switch (tokens[i].kind)
            {
            case Kind::open:
              levels.push_back({i + 1, {}});
              break;
            case Kind::close:
              finish(i);
              if (levels.size() > 1)
                levels.pop_back();
              break;
            case Kind::comma:
            case Kind::logical:
              finish(i);
              levels.back() = {i + 1, {}};
              break;
            case Kind::comparison:
              levels.back().comparisons.push_back(i);
              break;
            default:
              break;
            }
        finish(tokens.size());
      }

    private:
      struct Level
      {
        std::size_t              begin;
        std::vector<std::size_t> comparisons;
      };

      void
      finish(const std::size_t end) const
      {
        const Level &level = levels.back();
        if (level.comparisons.size() < 2)
          return;
        std::string meant;
        for (std::size_t k = 0; k < level.comparisons.size(); ++k)
          {
            const std::size_t left = k == 0 ? level.begin : level.comparisons[k - 1] + 1;
            const std::size_t right
              = k + 1 < level.comparisons.size() ? level.comparisons[k + 1] : end;
            meant += (k == 0 ? "" : " && ") + source(text, tokens, left, right);
          }
        refuse(what,
               text,
               "'" + source(text, tokens, level.begin, end)
                 + "' compares the outcome of the first comparison, 0 or 1, with what follows. "
                   "Write "
                 + meant + ", or set brackets.");
      }

      const std::string &text, &what;
      const Tokens      &tokens;
      std::vector<Level> levels;
    };

    /** How many arguments the call whose bracket is token @p open has. */
    unsigned int
    count_arguments(const Tokens &tokens, const std::size_t open)
    {
      unsigned int count = 0, depth = 0;
      for (std::size_t i = open; i < tokens.size(); ++i)
        {
          if (tokens[i].kind == Kind::open)
            ++depth;
          else if (tokens[i].kind == Kind::close && --depth == 0)
            return i == open + 1 ? 0 : count + 1;
          else if (tokens[i].kind == Kind::comma && depth == 1)
            ++count;
        }
      return count + 1;
    }

    bool
    calls_selector(const Tokens &tokens, const std::size_t i)
    {
      return tokens[i].kind == Kind::name && selector_arguments(tokens[i].text) > 0
             && i + 1 < tokens.size() && tokens[i + 1].kind == Kind::open;
    }

    std::string
    selector_form(const std::string &name)
    {
      if (name == "box")
        return "box(x0,y0,z0, x1,y1,z1) with two opposite corners";
      if (name == "sphere")
        return "sphere(x,y,z, r) with the centre and the radius";
      if (name == "cylinder")
        return "cylinder(x0,y0,z0, x1,y1,z1, r) with the ends of the axis and the radius";
      return "half_space(x,y,z, nx,ny,nz) with a point of the plane and the outer normal";
    }
  } // namespace

  std::vector<ExpressionToken>
  expression_tokens(const std::string &text)
  {
    static const char *const pairs[] = {"<=", ">=", "==", "!=", "&&", "||", "=<", "=>"};
    Tokens                   tokens;
    for (std::size_t i = 0; i < text.size();)
      {
        std::size_t end = i + 1;
        if (std::isspace(static_cast<unsigned char>(text[i])) != 0)
          {
            i = end;
            continue;
          }
        Kind kind = Kind::symbol;
        if (is_digit(text[i]) || (text[i] == '.' && end < text.size() && is_digit(text[end])))
          {
            kind = Kind::number;
            end  = end_of_number(text, i);
          }
        else if (is_letter(text[i]))
          {
            kind = Kind::name;
            while (end < text.size() && (is_letter(text[end]) || is_digit(text[end])))
              ++end;
          }
        else
          {
            for (const char *pair : pairs)
              if (text.compare(i, 2, pair) == 0)
                end = i + 2;
            kind = kind_of_symbol(text.substr(i, end - i));
          }
        tokens.push_back({kind, text.substr(i, end - i), i});
        i = end;
      }
    return tokens;
  }

  unsigned int
  selector_arguments(const std::string &name)
  {
    if (name == "sphere")
      return 4;
    if (name == "cylinder")
      return 7;
    return name == "box" || name == "half_space" ? 6 : 0;
  }

  void
  check_expression_syntax(const std::string &text, const std::string &what)
  {
    const Tokens tokens = expression_tokens(text);
    check_words(text, what, tokens);
    ChainCheck(text, what, tokens).run();
    for (std::size_t i = 0; i < tokens.size(); ++i)
      if (calls_selector(tokens, i))
        {
          const unsigned int count = count_arguments(tokens, i + 1);
          if (count != selector_arguments(tokens[i].text))
            refuse(what,
                   text,
                   "it gives " + std::to_string(count) + " arguments to "
                     + selector_form(tokens[i].text) + ".");
        }
  }

  std::string
  with_selector_points(const std::string &text)
  {
    const Tokens tokens = expression_tokens(text);
    std::string  result;
    std::size_t  done = 0;
    for (std::size_t i = 0; i < tokens.size(); ++i)
      if (calls_selector(tokens, i))
        {
          const std::size_t end = tokens[i + 1].position + 1;
          result += text.substr(done, end - done) + "x,y,z,";
          done = end;
        }
    return result + text.substr(done);
  }
} // namespace tetradapt::core
