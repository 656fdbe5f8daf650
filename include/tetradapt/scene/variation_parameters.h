// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_variation_parameters_h
#define tetradapt_scene_variation_parameters_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace tetradapt::scene
{
  /**
   * One thing that a study varies: one parameter, or several that change together.
   * A scene with variations is run once for every combination of their cases.
   */
  struct VariationParameters
  {
    std::string              name;
    std::vector<std::string> parameters;          ///< full names: "Adaptivity/Refinement indicator"
    std::vector<std::vector<std::string>> cases;  ///< one value a parameter in each
    std::vector<std::string>              labels; ///< one a case for tables, or none

    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    /** @throws core::InputError. Whether the values fit is seen when each scene is read. */
    void
    check() const;
  };
} // namespace tetradapt::scene

#endif
