// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/laws/law_catalogue.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/laws/linear_elastic.h"
#include "tetradapt/laws/neo_hookean.h"
#include "tetradapt/laws/st_venant_kirchhoff.h"

#include <algorithm>

namespace tetradapt::laws
{
  namespace
  {
    std::string
    not_positive(const double value)
    {
      return value > 0. ? "" : "must be positive";
    }

    const Constant young_modulus{"Young modulus",
                                 1.,
                                 "E, in the unit of pressure that the loads have; at rest.",
                                 not_positive};
    const Constant poisson_ratio{"Poisson ratio",
                                 0.3,
                                 "nu, between -1 and 0.5; 0.5 itself with Formulation = mixed "
                                 "only.",
                                 [](const double value) -> std::string {
                                   return value > -1. && value <= 0.5
                                            ? ""
                                            : "must be larger than -1 and at most 0.5";
                                 }};
    const Constant shear_modulus_constant{"Shear modulus",
                                          1.,
                                          "mu, in the unit of pressure that the loads have.",
                                          not_positive};
    const Constant bulk_modulus{"Bulk modulus",
                                1.,
                                "kappa, in the unit of pressure that the loads have.",
                                not_positive};

    /** An entry for a class that is built from these two constants. */
    template <class Law>
    LawEntry
    entry(const std::string &name,
          const std::string &documentation,
          const Constant    &stiffness,
          const Constant    &compressibility)
    {
      return {name,
              documentation,
              {stiffness, compressibility},
              stiffness.name,
              compressibility.name,
              [first = stiffness.name, second = compressibility.name](const Constants &values) {
                return std::make_unique<Law>(values.at(first), values.at(second));
              }};
    }
  } // namespace

  const std::vector<LawEntry> &
  law_catalogue()
  {
    static const std::vector<LawEntry> entries{
      entry<LinearElastic>(
        "linear elastic", "isotropic, small strains", young_modulus, poisson_ratio),
      entry<NeoHookean>("neo-Hookean",
                        "mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2, finite strains",
                        young_modulus,
                        poisson_ratio),
      entry<SplitNeoHookean>("split neo-Hookean",
                             "mu/2 (J^(-2/3) tr C - 3) + kappa/2 (J - 1)^2, finite strains",
                             shear_modulus_constant,
                             bulk_modulus),
      entry<StVenantKirchhoff>("St. Venant-Kirchhoff",
                               "lambda/2 (tr E)^2 + mu E : E, finite rotations with small strains",
                               young_modulus,
                               poisson_ratio)};
    return entries;
  }

  const LawEntry &
  find_law(const std::string &name)
  {
    const auto &entries = law_catalogue();
    const auto  found   = std::find_if(entries.begin(), entries.end(), [&](const LawEntry &entry) {
      return entry.name == name;
    });
    if (found != entries.end())
      return *found;
    std::string valid;
    for (const LawEntry &entry : entries)
      valid += (valid.empty() ? "'" : ", '") + entry.name + "'";
    throw core::InputError("there is no law '" + name + "'. Known are " + valid + ".");
  }

  std::vector<Constant>
  all_constants()
  {
    std::vector<Constant> result;
    for (const LawEntry &entry : law_catalogue())
      for (const Constant &constant : entry.constants)
        if (std::none_of(result.begin(), result.end(), [&](const Constant &other) {
              return other.name == constant.name;
            }))
          result.push_back(constant);
    return result;
  }

  Constants
  values_of(const std::string &name, const Constants &constants)
  {
    Constants values;
    for (const Constant &constant : find_law(name).constants)
      {
        const auto given      = constants.find(constant.name);
        values[constant.name] = given == constants.end() ? constant.standard : given->second;
      }
    return values;
  }

  std::unique_ptr<ConstitutiveLaw>
  make_law(const std::string &name, const Constants &constants)
  {
    return find_law(name).make(values_of(name, constants));
  }
} // namespace tetradapt::laws
