// SPDX-License-Identifier: AGPL-3.0-or-later
#include "consistency.h"
#include "require.h"
#include "values.h"

#include <algorithm>

namespace tetradapt::scene
{
  namespace
  {
    /** Stresses, energies and their squares stay in the range of double precision. */
    constexpr double smallest_modulus = 1e-50, largest_modulus = 1e50;

    /** The stiff material's rounding acts on the soft one: measured on two bars in a row,
     * the energy is wrong by 5e-8 at a contrast of 1e11, 4e-5 at 1e12, 2e-3 at 1e13. */
    constexpr double doubtful_contrast = 1e10, largest_contrast = 1e12;

    double
    modulus(const MaterialParameters &material)
    {
      return material.moduli_at_rest().young_modulus;
    }

    std::pair<const MaterialParameters *, const MaterialParameters *>
    softest_and_stiffest(const Scene &scene)
    {
      const auto ends
        = std::minmax_element(scene.materials.begin(),
                              scene.materials.end(),
                              [](const auto &a, const auto &b) { return modulus(a) < modulus(b); });
      return {&*ends.first, &*ends.second};
    }

    std::string
    contrast_message(const MaterialParameters &soft, const MaterialParameters &stiff)
    {
      return "is " + text_of(modulus(stiff)) + ", which is "
             + text_of(modulus(stiff) / modulus(soft)) + " times that of '" + soft.name + "': ";
    }
  } // namespace

  std::string
  constant_path(const MaterialParameters &material, std::string laws::LawEntry::*const constant)
  {
    return "Materials/" + material.name + "/" + laws::find_law(material.law).*constant;
  }

  void
  check_stiffness(const Scene &scene)
  {
    Mistakes mistakes;
    for (const auto &material : scene.materials)
      mistakes.require(modulus(material) >= smallest_modulus
                         && modulus(material) <= largest_modulus,
                       constant_path(material, &laws::LawEntry::stiffness),
                       "it is " + text_of(modulus(material)) + "; " + text_of(smallest_modulus)
                         + " to " + text_of(largest_modulus)
                         + " can be computed with. Choose another unit of stress.");
    const auto [soft, stiff] = softest_and_stiffest(scene);
    mistakes.require(modulus(*stiff) <= largest_contrast * modulus(*soft),
                     constant_path(*stiff, &laws::LawEntry::stiffness),
                     contrast_message(*soft, *stiff)
                       + "rounding in the stiff part would spoil the soft one. Lower it (a "
                         "contrast of 1e6 is practically rigid), or leave the stiff part out and "
                         "support the soft one where they meet.");
    mistakes.throw_together();
  }

  std::string
  stiffness_warning(const Scene &scene)
  {
    if (scene.materials.empty())
      return "";
    const auto [soft, stiff] = softest_and_stiffest(scene);
    if (!(modulus(*stiff) > doubtful_contrast * modulus(*soft)))
      return "";
    return constant_path(*stiff, &laws::LawEntry::stiffness) + ": "
           + contrast_message(*soft, *stiff)
           + "rounding in the stiff part leaves only some digits in the soft one. A contrast of "
             "1e6 is practically rigid.";
  }
} // namespace tetradapt::scene
