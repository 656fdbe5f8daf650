// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/condition.h"

#include "condition_parser.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/expression_tokens.h"

#include <algorithm>
#include <sstream>

namespace tetradapt::core
{
  Condition::Condition(const std::string &text, const std::string &what, const bool time_allowed)
    : expression(text, what), what(what)
  {
    const auto tokens = expression_tokens(text);
    if (!time_allowed && std::any_of(tokens.begin(), tokens.end(), [](const auto &token) {
          return token.is("t");
        }))
      throw InputError(what + ": the condition '" + text
                       + "' depends on the time t, but it is looked at once, before the solution. "
                         "Write it in x, y, z.");
    ConditionParser parser(what);
    root       = parser.parse(text);
    all_leaves = parser.take_leaves();
  }

  bool
  Condition::holds(const Point<3> &point, const double t) const
  {
    const double value = expression(point, t);
    if (value == 1.)
      return true;
    if (value == 0.)
      return false;
    std::ostringstream message;
    message << what << ": the condition '" << text() << "' has the value " << value << " at ("
            << point[0] << ", " << point[1] << ", " << point[2]
            << "), but a condition is 1 (true) or 0 (false). Compare the value with something, "
               "as in ("
            << text() << ") < 1e-9.";
    throw InputError(message.str());
  }

  namespace
  {
    bool
    combined(const ConditionNode &node, const std::vector<bool> &leaf_holds)
    {
      const auto holds = [&](const ConditionNode &child) { return combined(child, leaf_holds); };
      switch (node.kind)
        {
        case ConditionNode::Kind::all:
          return std::all_of(node.children.begin(), node.children.end(), holds);
        case ConditionNode::Kind::any:
          return std::any_of(node.children.begin(), node.children.end(), holds);
        case ConditionNode::Kind::negation:
          return !holds(node.children[0]);
        default:
          return leaf_holds[node.leaf];
        }
    }
  } // namespace

  bool
  Condition::combine(const std::vector<bool> &leaf_holds) const
  {
    return combined(root, leaf_holds);
  }
} // namespace tetradapt::core
