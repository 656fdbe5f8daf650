// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/expression.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/expression_tokens.h"
#include "tetradapt/core/selectors.h"
#include "tetradapt/core/surface_expression.h"

#include <muParser.h>

#include <cmath>
#include <sstream>

namespace tetradapt::core
{
  namespace
  {
    double
    choose(double condition, double yes, double no)
    {
      return condition != 0. ? yes : no;
    }
    double
    negate(double value)
    {
      return value == 0. ? 1. : 0.;
    }
    double
    power(double base, double exponent)
    {
      return std::pow(base, exponent);
    }
    double
    round_down(double value)
    {
      return std::floor(value);
    }
    double
    round_up(double value)
    {
      return std::ceil(value);
    }
    double
    remainder_of(double value, double divisor)
    {
      return std::fmod(value, divisor);
    }

    // The selectors, after the point.
    double
    box(double x, double y, double z, double a, double b, double c, double d, double e, double f)
    {
      return in_box({x, y, z}, {a, b, c}, {d, e, f}) ? 1. : 0.;
    }
    double
    sphere(double x, double y, double z, double a, double b, double c, double radius)
    {
      return in_sphere({x, y, z}, {a, b, c}, radius) ? 1. : 0.;
    }
    double
    cylinder(double x,
             double y,
             double z,
             double a,
             double b,
             double c,
             double d,
             double e,
             double f,
             double radius)
    {
      return in_cylinder({x, y, z}, {a, b, c}, {d, e, f}, radius) ? 1. : 0.;
    }
    double
    half_space(
      double x, double y, double z, double a, double b, double c, double d, double e, double f)
    {
      return in_half_space({x, y, z}, {a, b, c}, Point<3>(d, e, f)) ? 1. : 0.;
    }

    void
    define_names(mu::Parser &parser)
    {
      parser.DefineConst("pi", std::acos(-1.));
      parser.DefineConst("e", std::exp(1.));
      parser.DefineConst("everywhere", 1.); // a condition that always holds
      parser.DefineFun("if", choose);
      parser.DefineFun("pow", power);
      parser.DefineFun("floor", round_down);
      parser.DefineFun("ceil", round_up);
      parser.DefineFun("mod", remainder_of);
      parser.DefineInfixOprt("!", negate);
      parser.DefineFun("box", box);
      parser.DefineFun("sphere", sphere);
      parser.DefineFun("cylinder", cylinder);
      parser.DefineFun("half_space", half_space);
    }
  } // namespace

  namespace
  {
    /** A text and its parser, which points to the variables. */
    struct Parsed
    {
      Parsed(const Parsed &) = delete;
      Parsed &
      operator=(const Parsed &)
        = delete;

      std::string           text, what;
      std::array<double, 7> variables{}; ///< x, y, z, t, nx, ny, nz
      mu::Parser            parser;
      bool                  constant = false, normal = false;
      bool                  is_known = false; ///< a constant's value
      double                known    = 0.;

      Parsed(const std::string &text, const std::string &what, const bool with_normal = false)
        : text(text), what(what)
      {
        if (text.find_first_not_of(" \t\n\r") == std::string::npos)
          throw InputError(what + ": the expression is empty. Give a function of x, y, z and t.");
        check_expression_syntax(text, what);
        try
          {
            define_names(parser);
            const char *names[] = {"x", "y", "z", "t", "nx", "ny", "nz"};
            for (unsigned int i = 0; i < (with_normal ? 7 : 4); ++i)
              parser.DefineVar(names[i], &variables[i]);
            parser.SetExpr(with_selector_points(text));
            parser.Eval();
            int n_values = 0;
            parser.Eval(n_values);
            if (n_values != 1)
              throw InputError(what + ": '" + text + "' has " + std::to_string(n_values)
                               + " values separated by commas where one is wanted. Components of a "
                                 "vector are separated by semicolons.");
            const auto used = parser.GetUsedVar();
            constant        = used.empty();
            normal          = used.count("nx") + used.count("ny") + used.count("nz") > 0;
          }
        catch (const mu::Parser::exception_type &error)
          {
            throw InputError(what + ": the expression '" + text
                             + "' cannot be read: " + error.GetMsg() + " Known are x, y, z, t, "
                             + (with_normal ? "nx, ny, nz, " : "")
                             + "pi, e, if(c,a,b), box, sphere, "
                               "cylinder, half_space and the functions and operators of muParser.");
          }
        catch (const SelectorError &error)
          {
            throw InputError(what + ": the expression '" + text
                             + "' cannot be evaluated: " + error.what());
          }
      }

      /** At what the variables are. */
      double
      evaluate()
      {
        if (is_known)
          return known;
        const Point<3> point(variables[0], variables[1], variables[2]);
        const double   t = variables[3];
        double         value;
        try
          {
            value = parser.Eval();
          }
        catch (const mu::Parser::exception_type &error)
          {
            throw InputError(what + ": the expression '" + text
                             + "' cannot be evaluated: " + error.GetMsg());
          }
        catch (const SelectorError &error)
          {
            throw InputError(what + ": the expression '" + text
                             + "' cannot be evaluated: " + error.what());
          }
        if (!std::isfinite(value))
          {
            std::ostringstream message;
            message << what << ": the expression '" << text << "' is not finite at (" << point[0]
                    << ", " << point[1] << ", " << point[2] << ")";
            if (t != 0.)
              message << ", t = " << t;
            message << ". Change it so that it has a value everywhere on the mesh.";
            throw InputError(message.str());
          }
        is_known = constant;
        known    = value;
        return value;
      }
    };
  } // namespace

  struct Expression::Implementation : Parsed
  {
    using Parsed::Parsed;
  };

  Expression::Expression(const std::string &text, const std::string &what)
    : implementation(std::make_unique<Implementation>(text, what))
  {
  }

  Expression::Expression(const Expression &other)
    : Expression(other.implementation->text, other.implementation->what)
  {
  }

  Expression::Expression(Expression &&other) noexcept = default;

  Expression &
  Expression::operator=(const Expression &other)
  {
    return *this = Expression(other);
  }

  Expression &
  Expression::operator=(Expression &&other) noexcept = default;

  Expression::~Expression() = default;

  double
  Expression::operator()(const Point<3> &point, double t) const
  {
    implementation->variables = {{point[0], point[1], point[2], t, 0., 0., 0.}};
    return implementation->evaluate();
  }

  bool
  Expression::holds(const Point<3> &point, double t) const
  {
    return (*this)(point, t) != 0.;
  }

  bool
  Expression::is_constant() const
  {
    return implementation->constant;
  }

  const std::string &
  Expression::text() const
  {
    return implementation->text;
  }

  VectorExpression::VectorExpression(const std::array<std::string, 3> &texts,
                                     const std::string                &what)
    : components{{Expression(texts[0], what + ", component x"),
                  Expression(texts[1], what + ", component y"),
                  Expression(texts[2], what + ", component z")}}
  {
  }

  Tensor<1, 3>
  VectorExpression::operator()(const Point<3> &point, double t) const
  {
    Tensor<1, 3> value;
    for (unsigned int c = 0; c < 3; ++c)
      value[c] = components[c](point, t);
    return value;
  }

  bool
  VectorExpression::is_constant() const
  {
    return components[0].is_constant() && components[1].is_constant()
           && components[2].is_constant();
  }

  struct SurfaceExpression::Implementation
  {
    std::array<Parsed, 3> components;
  };

  SurfaceExpression::SurfaceExpression(const std::array<std::string, 3> &texts,
                                       const std::string                &what)
    : implementation(new Implementation{{{Parsed(texts[0], what + ", component x", true),
                                          Parsed(texts[1], what + ", component y", true),
                                          Parsed(texts[2], what + ", component z", true)}}})
  {
  }

  SurfaceExpression::SurfaceExpression(SurfaceExpression &&) noexcept = default;

  SurfaceExpression::~SurfaceExpression() = default;

  Tensor<1, 3>
  SurfaceExpression::operator()(const Point<3> &point, const Tensor<1, 3> &normal) const
  {
    Tensor<1, 3> value;
    for (unsigned int c = 0; c < 3; ++c)
      {
        Parsed &component   = implementation->components[c];
        component.variables = {{point[0], point[1], point[2], 0., normal[0], normal[1], normal[2]}};
        value[c]            = component.evaluate();
      }
    return value;
  }

  void
  SurfaceExpression::check(const std::string &text, const std::string &what)
  {
    Parsed parsed(text, what, true);
    if (parsed.constant)
      parsed.evaluate();
  }

  bool
  SurfaceExpression::is_constant() const
  {
    const auto &c = implementation->components;
    return c[0].constant && c[1].constant && c[2].constant;
  }

  bool
  SurfaceExpression::uses_normal() const
  {
    const auto &c = implementation->components;
    return c[0].normal || c[1].normal || c[2].normal;
  }
} // namespace tetradapt::core
