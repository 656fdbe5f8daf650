// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/constitutive_law.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mechanics/linear_elastic.h"

#include <functional>
#include <map>

namespace tetradapt::mechanics
{
  namespace
  {
    using Maker
      = std::function<std::unique_ptr<ConstitutiveLaw>(const scene::MaterialParameters &)>;

    /** A new law needs one line here. */
    const std::map<std::string, Maker> &
    makers()
    {
      static const std::map<std::string, Maker> table{
        {"linear elastic", [](const scene::MaterialParameters &p) {
           return std::make_unique<LinearElastic>(p.young_modulus, p.poisson_ratio);
         }}};
      return table;
    }
  } // namespace

  std::vector<std::string>
  law_names()
  {
    std::vector<std::string> names;
    for (const auto &entry : makers())
      names.push_back(entry.first);
    return names;
  }

  void
  require_linear(const ConstitutiveLaw &law, const scene::MaterialParameters &material)
  {
    if (!law.is_linear())
      throw core::InputError("Materials/" + material.name + "/Law: '" + material.law
                             + "' is not linear, and only linear laws can be solved. Choose "
                               "a linear one, such as linear elastic.");
  }

  std::unique_ptr<ConstitutiveLaw>
  make_law(const scene::MaterialParameters &parameters)
  {
    const auto maker = makers().find(parameters.law);
    if (maker == makers().end())
      {
        std::string valid;
        for (const auto &name : law_names())
          valid += (valid.empty() ? "'" : ", '") + name + "'";
        throw core::InputError("Materials/" + parameters.name + "/Law: there is no law '"
                               + parameters.law + "'. Known are " + valid + ".");
      }
    return maker->second(parameters);
  }
} // namespace tetradapt::mechanics
