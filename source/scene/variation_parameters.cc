// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/variation_parameters.h"

#include "binder.h"
#include "require.h"

namespace tetradapt::scene
{
  namespace
  {
    void
    bind(VariationParameters &p, Binder &binder)
    {
      binder("Parameters",
             p.parameters,
             parameter_names_codec(),
             "Which parameter varies, such as TetGen/Radius-edge ratio; several that change "
             "together are separated by &.");
      binder("Values",
             p.cases,
             cases_codec(),
             "Its values, separated by |; for several parameters each case has one value for "
             "each, separated by &.");
      binder("Labels",
             p.labels,
             labels_codec(),
             "Names of the cases for the table, separated by |; empty: the values.");
    }
  } // namespace

  void
  VariationParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  VariationParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  void
  VariationParameters::check() const
  {
    Mistakes          mistakes;
    const std::string path = "Study/" + name + "/";
    mistakes.require(!parameters.empty(), path + "Parameters", "name the parameter that varies.");
    mistakes.require(!cases.empty(), path + "Values", "give at least one value.");
    for (const auto &values : cases)
      mistakes.require(parameters.empty() || values.size() == parameters.size(),
                       path + "Values",
                       "a case has " + std::to_string(values.size()) + " values for "
                         + std::to_string(parameters.size())
                         + " parameters. Separate cases by |, and values in a case by &.");
    for (const auto &parameter : parameters)
      mistakes.require(parameter.compare(0, 6, "Study/") != 0,
                       path + "Parameters",
                       "a study cannot vary a study.");
    mistakes.require(labels.empty() || labels.size() == cases.size(),
                     path + "Labels",
                     "there are " + std::to_string(labels.size()) + " labels for "
                       + std::to_string(cases.size()) + " cases. Give one each, or none.");
    mistakes.throw_together();
  }
} // namespace tetradapt::scene
