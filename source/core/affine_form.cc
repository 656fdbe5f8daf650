// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/affine_form.h"

#include "tetradapt/core/expression.h"
#include "tetradapt/core/expression_tokens.h"

#include <cmath>

namespace tetradapt::core
{
  namespace
  {
    using Form = std::optional<AffineForm>;

    bool
    is_number(const AffineForm &form)
    {
      return form.gradient.norm_square() == 0.;
    }

    AffineForm
    number(const double value)
    {
      AffineForm form;
      form.constant = value;
      return form;
    }

    AffineForm
    scaled(AffineForm form, const double factor)
    {
      form.gradient *= factor;
      form.constant *= factor;
      return form;
    }

    /** Descends through sums, products, signs and powers in muParser's order. */
    class AffineParser
    {
    public:
      AffineParser(const std::string &text) : text(text), tokens(expression_tokens(text))
      {
      }

      Form
      run()
      {
        const Form form = sum();
        if (!form || next != tokens.size() || !std::isfinite(form->constant)
            || !std::isfinite(form->gradient.norm()))
          return {};
        return form;
      }

    private:
      bool
      take(const char *symbol)
      {
        if (next == tokens.size() || !tokens[next].is(symbol))
          return false;
        ++next;
        return true;
      }

      Form
      sum()
      {
        Form left = product();
        while (left)
          {
            const double sign = take("+") ? 1. : take("-") ? -1. : 0.;
            if (sign == 0.)
              return left;
            const Form right = product();
            if (!right)
              return {};
            left->gradient += sign * right->gradient;
            left->constant += sign * right->constant;
          }
        return left;
      }

      Form
      product()
      {
        Form left = with_sign();
        while (left)
          {
            const bool times = take("*");
            if (!times && !take("/"))
              return left;
            const Form right = with_sign();
            if (!right)
              return {};
            if (is_number(*right))
              left = scaled(*left, times ? right->constant : 1. / right->constant);
            else if (times && is_number(*left))
              left = scaled(*right, left->constant);
            else
              return {};
          }
        return left;
      }

      Form
      with_sign()
      {
        if (take("-"))
          {
            const Form form = with_sign();
            return form ? Form(scaled(*form, -1.)) : form;
          }
        return take("+") ? with_sign() : power();
      }

      Form
      power()
      {
        const Form base = primary();
        if (!base || !take("^"))
          return base;
        const Form exponent = with_sign();
        if (!exponent || !is_number(*exponent))
          return {};
        if (exponent->constant == 1.)
          return base;
        if (!is_number(*base))
          return {};
        return number(std::pow(base->constant, exponent->constant));
      }

      Form
      primary()
      {
        using Kind = ExpressionToken::Kind;
        if (next == tokens.size())
          return {};
        const ExpressionToken &token = tokens[next];
        if (token.kind == Kind::number)
          {
            ++next;
            return number(std::stod(token.text));
          }
        if (take("("))
          {
            const Form form = sum();
            return form && take(")") ? form : Form();
          }
        if (token.kind != Kind::name)
          return {};
        ++next;
        if (next < tokens.size() && tokens[next].kind == Kind::open)
          return call(next - 1);
        for (unsigned int d = 0; d < 3; ++d)
          if (token.text == std::string(1, "xyz"[d]))
            {
              AffineForm form;
              form.gradient[d] = 1.;
              return form;
            }
        return token.is("t") ? Form() : constant(token.text);
      }

      /** The call that begins at token @p name, if it is a number. */
      Form
      call(const std::size_t name)
      {
        using Kind         = ExpressionToken::Kind;
        unsigned int depth = 0;
        do
          {
            if (tokens[next].kind == Kind::open)
              ++depth;
            else if (tokens[next].kind == Kind::close)
              --depth;
            ++next;
        } while (depth > 0 && next < tokens.size());
        const std::size_t begin = tokens[name].position;
        return constant(text.substr(begin, tokens[next - 1].position + 1 - begin));
      }

      static Form
      constant(const std::string &part)
      {
        const Expression expression(part, "constant");
        return expression.is_constant() ? Form(number(expression(Point<3>()))) : Form();
      }

      const std::string                  text;
      const std::vector<ExpressionToken> tokens;
      std::size_t                        next = 0;
    };
  } // namespace

  std::optional<AffineForm>
  affine_form(const std::string &text)
  {
    return AffineParser(text).run();
  }
} // namespace tetradapt::core
