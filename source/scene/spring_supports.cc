// SPDX-License-Identifier: AGPL-3.0-or-later
#include "spring_supports.h"

#include "require.h"

#include <algorithm>

namespace tetradapt::scene
{
  void
  bind_spring(SupportParameters &support, const std::array<bool, 3> &components, Binder &binder)
  {
    binder("Stiffness",
           support.spring.stiffness,
           text_codec("an expression in x, y, z"),
           "spring: k, force per area and displacement: an expression in x, y, z that is nowhere "
           "negative.");
    binder("Direction",
           support.spring.direction,
           word_codec<SpringDirection>(),
           "spring: which displacements it resists: all, or those along the normal, which is that "
           "of the surface that Mesh/Projection names at the nearest point, else that of the face "
           "of the mesh.");
    if (!binder.parsing())
      return;
    support.components = components;
    if (support.type != SupportType::spring)
      return;
    require(
      components == SupportParameters().components,
      "Supports/" + support.name + "/Components",
      "springs resist all displacements, or those along the normal, as Direction says. Remove "
      "this.");
    support.components.fill(false);
  }

  void
  check_spring(const SupportParameters &support, Mistakes &mistakes)
  {
    const std::string      path = "Supports/" + support.name;
    const SpringParameters defaults;
    if (support.type != SupportType::spring)
      {
        const std::string advice = "only springs have it. Set Type = spring, or remove this.";
        mistakes.require(support.spring.stiffness == defaults.stiffness,
                         path + "/Stiffness",
                         advice);
        mistakes.require(support.spring.direction == defaults.direction,
                         path + "/Direction",
                         advice);
        return;
      }
    mistakes.require(!support.place.is_set(),
                     path + (support.place.line ? "/Line" : "/Point"),
                     "springs have a stiffness per area, and act on faces: choose them by Boundary "
                     "ids, Groups or Where.");
    double value    = 0.;
    bool   constant = false;
    if (mistakes.attempt([&]() {
          constant = constant_value(support.spring.stiffness, path + "/Stiffness", value);
        }))
      mistakes.require(!constant || value > 0.,
                       path + "/Stiffness",
                       value == 0. ? "give the stiffness of the springs, force per area and "
                                     "displacement, such as 1e4; it is 0."
                                   : "must not be negative; it is " + text_of(value) + ".");
  }

  void
  check_spring_supports(const Scene &scene)
  {
    const auto spring
      = std::find_if(scene.supports.begin(), scene.supports.end(), [](const auto &support) {
          return support.type == SupportType::spring;
        });
    if (spring == scene.supports.end())
      return;
    const std::string name = "Supports/" + spring->name;
    Mistakes          mistakes;
    mistakes.require(
      scene.formulation != Formulation::mixed,
      "Formulation",
      "springs such as " + name
        + " are not for the mixed form. Use Formulation = displacement, or fixed supports.");
    mistakes.require(scene.reference.type != ReferenceParameters::Type::hexahedra,
                     "Reference/Type",
                     "hexahedra know no springs such as " + name + ". Use Type = fine mesh.");
    mistakes.require(
      !scene.exact_solution.has_energy(),
      "Exact solution/Strain energy",
      "the strain energy of the body alone does not tell the error where it stands on "
      "springs such as "
        + name + ". Give Exact solution/Displacement, or remove this.");
    mistakes.throw_together();
  }
} // namespace tetradapt::scene
