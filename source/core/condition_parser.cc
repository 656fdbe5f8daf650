// SPDX-License-Identifier: AGPL-3.0-or-later
#include "condition_parser.h"

#include "expression_parts.h"

#include "tetradapt/core/affine_form.h"
#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <sstream>

namespace tetradapt::core
{
  namespace
  {
    using Kind = ExpressionToken::Kind;
    using Node = ConditionNode;

    Node
    combine(const Node::Kind kind, std::vector<Node> children)
    {
      if (children.size() == 1 && kind != Node::Kind::negation)
        return children[0];
      Node node;
      node.kind     = kind;
      node.children = std::move(children);
      return node;
    }

    bool
    is_logical(const ExpressionToken &token)
    {
      return token.kind == Kind::comparison || token.kind == Kind::logical || token.is("!")
             || selector_arguments(token.text) > 0;
    }

    bool
    has_logic(const Tokens &tokens)
    {
      return std::any_of(tokens.begin(), tokens.end(), is_logical);
    }

    /** Factors in brackets that are conditions, or selectors. */
    bool
    is_condition_factor(const std::string &text)
    {
      const Tokens tokens = expression_tokens(text);
      if (is_call(tokens))
        return selector_arguments(tokens[0].text) > 0;
      if (!in_brackets(tokens))
        return false;
      const Tokens inner = expression_tokens(bare(text));
      return !outside_brackets(inner, is_logical).empty();
    }
  } // namespace

  ConditionParser::ConditionParser(const std::string &what) : what(what)
  {
  }

  ConditionNode
  ConditionParser::parse(const std::string &with_brackets)
  {
    const std::string text   = bare(with_brackets);
    const Tokens      tokens = expression_tokens(text);
    const auto        choice = outside_brackets(tokens, "?");
    if (!choice.empty())
      {
        // The colon of the first question: nested ones open and close in between.
        unsigned int open  = 0;
        std::size_t  colon = choice[0];
        for (const std::size_t i : outside_brackets(tokens, [](const ExpressionToken &token) {
               return token.is("?") || token.is(":");
             }))
          {
            open += tokens[i].is("?") ? 1 : -1;
            colon = i;
            if (open == 0)
              break;
          }
        return parse_choice(part(text, tokens, 0, choice[0]),
                            part(text, tokens, choice[0] + 1, colon),
                            part(text, tokens, colon + 1, tokens.size()));
      }
    for (const auto &[symbol, kind] :
         {std::make_pair("||", Node::Kind::any), std::make_pair("&&", Node::Kind::all)})
      {
        const auto at = outside_brackets(tokens, symbol);
        if (at.empty())
          continue;
        std::vector<Node> children;
        for (const std::string &piece : pieces(text, tokens, at))
          children.push_back(parse(piece));
        return combine(kind, children);
      }
    if (!tokens.empty() && tokens[0].is("!"))
      return parse_negation(text, tokens);
    return parse_item(text, tokens);
  }

  ConditionNode
  ConditionParser::parse_choice(const std::string &condition,
                                const std::string &yes,
                                const std::string &no)
  {
    // In turn: the order of evaluation of a list's elements numbers the leaves.
    std::vector<Node> first, second;
    first.push_back(parse(condition));
    first.push_back(parse(yes));
    second.push_back(combine(Node::Kind::negation, {first[0]}));
    second.push_back(parse(no));
    return combine(Node::Kind::any,
                   {combine(Node::Kind::all, first), combine(Node::Kind::all, second)});
  }

  ConditionNode
  ConditionParser::parse_negation(const std::string &text, const Tokens &tokens)
  {
    const std::string rest  = part(text, tokens, 1, tokens.size());
    const Tokens      inner = expression_tokens(rest);
    if (in_brackets(inner) || is_call(inner) || (!inner.empty() && inner[0].is("!")))
      return combine(Node::Kind::negation, {parse(rest)});
    if (outside_brackets(inner, [](const ExpressionToken &token) {
          return token.kind == Kind::comparison;
        }).empty())
      return number_or_truth(text, tokens);
    throw InputError(what + ": in the condition '" + text
                     + "' the ! negates what stands next to it, before the comparison. Write !("
                     + rest + ").");
  }

  ConditionNode
  ConditionParser::parse_item(const std::string &text, const Tokens &tokens)
  {
    const auto comparisons = outside_brackets(tokens, [](const ExpressionToken &token) {
      return token.kind == Kind::comparison;
    });
    if (!comparisons.empty())
      {
        const std::string left  = bare(part(text, tokens, 0, comparisons[0]));
        const std::string sign  = tokens[comparisons[0]].text;
        const std::string right = bare(part(text, tokens, comparisons[0] + 1, tokens.size()));
        if (sign == "<" || sign == "<=")
          return less(left, sign, right);
        if (sign == ">" || sign == ">=")
          return less(right, sign == ">" ? "<" : "<=", left);
        return number_or_truth(text, tokens);
      }
    if (is_call(tokens) && selector_arguments(tokens[0].text) > 0)
      return parse_selector(text, arguments_of(text));
    if (is_call_of(text, "if"))
      {
        const auto arguments = arguments_of(text);
        return parse_choice(arguments[0], arguments[1], arguments[2]);
      }
    const auto factors = pieces(text, tokens, outside_brackets(tokens, "*"));
    if (factors.size() > 1 && std::all_of(factors.begin(), factors.end(), is_condition_factor))
      {
        std::vector<Node> children;
        for (const std::string &factor : factors)
          children.push_back(parse(factor));
        return combine(Node::Kind::all, children);
      }
    return number_or_truth(text, tokens);
  }

  ConditionNode
  ConditionParser::less(const std::string &left, const std::string &sign, const std::string &right)
  {
    const auto each = [&](const Node::Kind kind, const bool is_left, const auto &items) {
      std::vector<Node> children;
      for (const std::string &item : items)
        children.push_back(is_left ? less(bare(item), sign, right) : less(left, sign, bare(item)));
      return combine(kind, children);
    };
    const auto both_signs = [](const std::string &text) {
      const std::string inside = arguments_of(text)[0];
      return std::vector<std::string>{inside, "-(" + inside + ")"};
    };
    if (is_call_of(left, "abs"))
      return each(Node::Kind::all, true, both_signs(left));
    if (is_call_of(left, "max"))
      return each(Node::Kind::all, true, arguments_of(left));
    if (is_call_of(left, "min"))
      return each(Node::Kind::any, true, arguments_of(left));
    if (is_call_of(right, "abs"))
      return each(Node::Kind::any, false, both_signs(right));
    if (is_call_of(right, "max"))
      return each(Node::Kind::any, false, arguments_of(right));
    if (is_call_of(right, "min"))
      return each(Node::Kind::all, false, arguments_of(right));

    const std::string text = left + " " + sign + " " + right;
    const auto        a = affine_form(left), b = affine_form(right);
    if (a && b)
      return add_plane(a->gradient - b->gradient, b->constant - a->constant, sign == "<=", text);
    ConditionLeaf leaf;
    leaf.kind            = ConditionLeaf::Kind::general;
    leaf.text            = text;
    leaf.includes_border = sign == "<=";
    leaf.difference.emplace("(" + left + ") - (" + right + ")", what);
    leaf.truth.emplace("(" + left + ") " + sign + " (" + right + ")", what);
    return add(leaf);
  }

  ConditionNode
  ConditionParser::parse_selector(const std::string              &text,
                                  const std::vector<std::string> &arguments)
  {
    std::vector<double> v;
    for (const std::string &argument : arguments)
      {
        const Expression expression(argument, what);
        if (!expression.is_constant())
          return number_or_truth(text, expression_tokens(text));
        v.push_back(expression(Point<3>()));
      }
    const std::string name = expression_tokens(text)[0].text;
    const Point<3>    first(v[0], v[1], v[2]);
    ConditionLeaf     leaf;
    leaf.text = text;
    if (name == "sphere")
      {
        leaf.kind   = ConditionLeaf::Kind::sphere;
        leaf.center = first;
        leaf.radius = v[3];
        return add(leaf);
      }
    const Point<3> second(v[3], v[4], v[5]);
    if (name == "half_space")
      return add_plane(second, second * Tensor<1, 3>(first), true, text);
    std::vector<Node> children;
    if (name == "box")
      {
        for (unsigned int d = 0; d < 3; ++d)
          {
            Tensor<1, 3> normal;
            normal[d] = 1.;
            children.push_back(add_plane(normal, std::max(first[d], second[d]), true, text));
            children.push_back(add_plane(-normal, -std::min(first[d], second[d]), true, text));
          }
        return combine(Node::Kind::all, children);
      }
    leaf.kind   = ConditionLeaf::Kind::cylinder;
    leaf.center = first;
    leaf.radius = v[6];
    leaf.normal = (second - first) / (second - first).norm();
    children.push_back(add(leaf));
    children.push_back(add_plane(leaf.normal, leaf.normal * Tensor<1, 3>(second), true, text));
    children.push_back(add_plane(-leaf.normal, -(leaf.normal * Tensor<1, 3>(first)), true, text));
    return combine(Node::Kind::all, children);
  }

  ConditionNode
  ConditionParser::number_or_truth(const std::string &text, const Tokens &tokens)
  {
    ConditionLeaf    leaf;
    const Expression expression(text, what);
    const bool       calls    = std::any_of(tokens.begin(), tokens.end(), [&](const auto &token) {
      return token.kind == Kind::name && &token != &tokens.back()
             && (&token + 1)->kind == Kind::open;
    });
    const bool       constant = expression.is_constant();
    const double     value    = constant ? expression(Point<3>()) : 0.;
    if (constant ? value != 0. && value != 1. : !calls && !has_logic(tokens))
      {
        std::ostringstream message;
        message << what << ": '" << text << "' is a number, not a condition that is true or false";
        if (constant)
          message << " (its value is " << value << ")";
        message << ". Compare it with something, as in " << text << " < 1e-9.";
        throw InputError(message.str());
      }
    leaf.text = text;
    if (constant)
      leaf.offset = value == 1. ? -1. : 1.;
    else
      {
        leaf.kind = ConditionLeaf::Kind::truth;
        leaf.truth.emplace(expression);
      }
    return add(leaf);
  }

  ConditionNode
  ConditionParser::add(ConditionLeaf leaf)
  {
    Node node;
    node.leaf = leaves.size();
    leaves.push_back(std::move(leaf));
    return node;
  }

  ConditionNode
  ConditionParser::add_plane(const Tensor<1, 3> &normal,
                             const double        offset,
                             const bool          includes_border,
                             const std::string  &text)
  {
    ConditionLeaf leaf;
    leaf.text            = text;
    leaf.includes_border = includes_border;
    const double length  = normal.norm();
    if (length == 0.)
      leaf.offset = offset > 0. || (offset == 0. && includes_border) ? -1. : 1.;
    else
      {
        leaf.kind   = ConditionLeaf::Kind::affine;
        leaf.normal = normal / length;
        leaf.offset = offset / length;
      }
    return add(leaf);
  }
} // namespace tetradapt::core
