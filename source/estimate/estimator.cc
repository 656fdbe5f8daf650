// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/estimator.h"

#include "tetradapt/core/exceptions.h"

namespace tetradapt::estimate
{
  namespace
  {
    std::vector<std::unique_ptr<Estimator>>
    all_estimators()
    {
      std::vector<std::unique_ptr<Estimator>> all;
      all.push_back(std::make_unique<ExtrapolationEnergy>());
      all.push_back(std::make_unique<ExtrapolationRen>());
      all.push_back(std::make_unique<ExactEnergy>());
      return all;
    }
  } // namespace



  std::vector<std::string>
  estimator_names()
  {
    std::vector<std::string> names;
    for (const auto &estimator : all_estimators())
      names.push_back(estimator->name());
    return names;
  }



  std::unique_ptr<Estimator>
  make_estimator(const std::string &name)
  {
    std::string valid;
    for (auto &estimator : all_estimators())
      {
        if (estimator->name() == name)
          return std::move(estimator);
        valid += (valid.empty() ? "'" : ", '") + estimator->name() + "'";
      }
    throw core::InputError("There is no error estimator '" + name + "'. Choose one of " + valid
                           + ".");
  }



  std::string
  estimator_name(const scene::AdaptivityParameters::Driver driver)
  {
    using Driver = scene::AdaptivityParameters::Driver;
    switch (driver)
      {
      case Driver::ren:
        return ExtrapolationRen().name();
      case Driver::exact:
        return ExactEnergy().name();
      case Driver::energy:
        break;
      }
    return ExtrapolationEnergy().name();
  }
} // namespace tetradapt::estimate
