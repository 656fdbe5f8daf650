// SPDX-License-Identifier: AGPL-3.0-or-later
#include "consistency.h"

#include "require.h"
#include "values.h"

#include "tetradapt/scene/words.h"

namespace tetradapt::scene
{
  namespace
  {
    /** Above these the displacement form is warned of, by degree; measured in
     * doc/mixed_form.md. */
    constexpr double locking_nu[2] = {0.49, 0.499};
    /** Above this the displacement form is refused: rounding alone spoils its figures. */
    constexpr double largest_nu = 0.49999;

    double
    poisson_ratio(const MaterialParameters &material)
    {
      return material.moduli_at_rest().poisson_ratio;
    }

    void
    check_laws(const Scene &scene)
    {
      Mistakes mistakes;
      for (const auto &material : scene.materials)
        {
          const auto  law = laws::make_law(material.law, material.constants);
          std::string others;
          for (const auto &[formulation, name] : words(Formulation()))
            if (law->supports(formulation))
              others += (others.empty() ? "" : " or ") + name;
          mistakes.require(law->supports(scene.formulation),
                           "Materials/" + material.name + "/Law",
                           "the law '" + material.law
                             + "' is not for Formulation = " + word(scene.formulation)
                             + ". Set Formulation = " + others + ", or choose another law.");
        }
      mistakes.throw_together();
    }

    void
    check_displacement_form(const Scene &scene)
    {
      Mistakes mistakes;
      for (const auto &material : scene.materials)
        mistakes.require(
          poisson_ratio(material) <= largest_nu,
          constant_path(material, &laws::LawEntry::compressibility),
          "the " + word(scene.formulation)
            + " form cannot solve for a material with a Poisson ratio of "
            + text_of(poisson_ratio(material)) + ": elements lock above " + text_of(largest_nu)
            + ". "
            + (scene.formulation == Formulation::finite_strain
                 ? "Make the material more compressible."
                 : "Set Formulation = mixed and Degree = 2, which serve up to 0.5 itself."));
      mistakes.throw_together();
    }

    void
    check_mixed_estimator(const ErrorEstimator which, const std::string &path)
    {
      using E = ErrorEstimator;
      require(which == E::energy || which == E::ren || which == E::exact || which == E::averaging
                || which == E::spr || which == E::residual,
              path,
              "the estimator '" + word(which)
                + "' is for the displacement form only. With Formulation = mixed there are spr, "
                  "averaging, residual, "
                + word(E::energy) + ", " + word(E::ren) + " and " + word(E::exact) + ".");
    }

    void
    check_mixed_form(const Scene &scene)
    {
      Mistakes mistakes;
      mistakes.require(
        scene.degree == 2,
        "Formulation",
        "mixed needs Degree = 2: the pressure is linear, and linear displacements with it are "
        "unstable.");
      for (const auto &material : scene.materials)
        mistakes.require(
          poisson_ratio(material) > 0.,
          constant_path(material, &laws::LawEntry::compressibility),
          "must be positive with Formulation = mixed, not " + text_of(poisson_ratio(material))
            + ". For a body without nearly incompressible parts leave out Formulation.");
      using Reference = ReferenceParameters::Type;
      mistakes.require(
        scene.reference.type == Reference::none
          || (scene.reference.type == Reference::fine_mesh && scene.reference.degree == 2),
        "Reference/"
          + std::string(scene.reference.type == Reference::fine_mesh ? "Degree" : "Type"),
        "with Formulation = mixed the reference must also be solved in mixed form: use Type = fine "
        "mesh and Degree = 2.");
      for (const auto &goal : scene.goals)
        mistakes.require(
          goal.type == GoalType::point_displacement || goal.type == GoalType::mean_displacement,
          "Goals/" + goal.name + "/Type",
          "a goal of stresses is for the displacement form only. With Formulation = mixed "
          "use a point or mean displacement.");
      for (const ErrorEstimator which : scene.estimation.estimators)
        mistakes.attempt([&]() { check_mixed_estimator(which, "Estimation/Estimators"); });
      if (scene.adaptivity.strategy == AdaptivityParameters::Strategy::adaptive)
        mistakes.attempt([&]() {
          check_mixed_estimator(scene.adaptivity.refinement_indicator,
                                "Adaptivity/Refinement indicator");
        });
      mistakes.throw_together();
    }
  } // namespace

  void
  check_formulation(const Scene &scene)
  {
    check_laws(scene);
    if (scene.formulation == Formulation::mixed)
      check_mixed_form(scene);
    else
      check_displacement_form(scene);
    if (scene.formulation == Formulation::finite_strain)
      check_finite_strain(scene);
  }

  std::vector<std::string>
  locking_warnings(const Scene &scene)
  {
    std::vector<std::string> messages;
    if (scene.formulation != Formulation::mixed)
      for (const auto &material : scene.materials)
        if (poisson_ratio(material) > locking_nu[scene.degree - 1])
          messages.push_back(constant_path(material, &laws::LawEntry::compressibility)
                             + ": with a Poisson ratio above "
                             + text_of(locking_nu[scene.degree - 1])
                             + (scene.degree == 1 ? " linear" : " quadratic")
                             + " elements lock in displacement form: they are too stiff on coarse "
                               "meshes, and their stresses oscillate. "
                             + (scene.formulation == Formulation::finite_strain
                                  ? (scene.degree == 1 ? "Set Degree = 2." : "Use a fine mesh.")
                                : scene.degree == 1 ? "Set Formulation = mixed and Degree = 2."
                                                    : "Set Formulation = mixed."));
    return messages;
  }
} // namespace tetradapt::scene
