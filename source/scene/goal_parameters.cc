// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/goal_parameters.h"

#include "binder.h"
#include "face_choice.h"
#include "require.h"

#include <algorithm>

namespace tetradapt::scene
{
  namespace
  {
    const std::array<const char *, 3> vector_components{{"x", "y", "z"}};
    const std::array<const char *, 6> stress_components{{"xx", "yy", "zz", "xy", "yz", "zx"}};

    void
    bind(GoalParameters &p, Binder &binder)
    {
      binder("Type",
             p.type,
             word_codec<GoalType>(),
             "point displacement: a component of the displacement at Point. mean displacement: its "
             "mean over faces. point stress: a component of the stress, averaged over a ball "
             "around Point. mean stress: its mean over the body with Weight. functional: the "
             "integral of the weights below times displacement and stress.");
      binder("Point", p.point, point_codec(), "point displacement, point stress: where.");
      binder("Radius",
             p.radius,
             number_codec(),
             "point stress: radius R of the ball; the stress is averaged with (1 - r^2/R^2)^2.");
      binder("Component",
             p.component,
             text_codec("x, y or z, and for stresses xx, yy, zz, xy, yz or zx"),
             "All but functional: which component.");
      binder("Weight",
             p.weight,
             text_codec("an expression in x, y, z"),
             "mean displacement, mean stress: weight of the mean. A smooth weight, such as that of "
             "a ball in point stress, is integrated more accurately than one with jumps.");
      binder("Boundary ids", p.selector.ids, ids_codec(), "Ids of the faces of a mean.");
      binder("Groups", p.selector.groups, names_codec(), "Names of such groups of faces.");
      bind_where(p.selector, binder);
      binder("Displacement weight",
             p.displacement_weight,
             expressions_codec<3>(true),
             "functional: times the displacement, over the body.");
      binder("Traction weight",
             p.traction_weight,
             expressions_codec<3>(true),
             "functional: times the displacement, over the chosen faces.");
      binder("Stress weight",
             p.stress_weight,
             expressions_codec<6>(true),
             "functional: times the stresses xx; yy; zz; xy; yz; zx, over the body.");
      binder("Exact value", p.exact, optional_number_codec(), "Its exact value; empty: unknown.");
    }

    template <std::size_t n>
    std::string
    list(const std::array<const char *, n> &names)
    {
      std::string text;
      for (const char *name : names)
        text += (text.empty() ? "" : ", ") + std::string(name);
      return text;
    }

    template <std::size_t n>
    unsigned int
    index_of(const std::array<const char *, n> &names, const GoalParameters &goal)
    {
      const auto found = std::find(names.begin(), names.end(), goal.component);
      require(found != names.end(),
              "Goals/" + goal.name + "/Component",
              "'" + goal.component + "' is not a component of a "
                + (n == 3 ? "displacement" : "stress") + ". Choose one of " + list(names) + ".");
      return found - names.begin();
    }

    template <std::size_t n>
    void
    check_weights(const std::array<std::string, n> &weights, const std::string &path)
    {
      if (!weights[0].empty())
        for (const auto &weight : weights)
          check_expression(weight, path);
    }
  } // namespace

  unsigned int
  GoalParameters::component_index() const
  {
    return is_stress() ? index_of(stress_components, *this) : index_of(vector_components, *this);
  }

  void
  GoalParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  GoalParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  void
  GoalParameters::check() const
  {
    Mistakes          mistakes;
    const std::string path = "Goals/" + name + "/";
    if (type != GoalType::functional)
      mistakes.attempt([&]() { component_index(); });
    mistakes.require(
      type != GoalType::point_stress || radius > 0.,
      path + "Radius",
      "a point stress is a mean over a ball: give its radius, smaller than what the stress "
      "varies over.");
    mistakes.attempt([&]() {
      double constant;
      require(!constant_value(weight, path + "Weight", constant) || constant > 0.,
              path + "Weight",
              "must be positive somewhere; it is " + weight + ".");
    });
    const bool has_function
      = !displacement_weight[0].empty() || !traction_weight[0].empty() || !stress_weight[0].empty();
    mistakes.require(
      type == GoalType::functional || !has_function,
      path + "Type",
      "Displacement weight, Traction weight and Stress weight are for Type = functional.");
    mistakes.require(type != GoalType::functional || has_function,
                     path + "Type",
                     "a functional needs Displacement weight, Traction weight or Stress weight.");
    mistakes.attempt([&]() { check_weights(displacement_weight, path + "Displacement weight"); });
    mistakes.attempt([&]() { check_weights(traction_weight, path + "Traction weight"); });
    mistakes.attempt([&]() { check_weights(stress_weight, path + "Stress weight"); });
    mistakes.require(
      uses_faces() || selector.empty(),
      path + "Where",
      "Boundary ids, Groups and Where choose the faces of a mean displacement or of a "
      "Traction weight; a mean stress is chosen by its Weight.");
    if (uses_faces())
      mistakes.attempt([&]() { check_faces(selector, "Goals/" + name); });
    mistakes.throw_together();
  }
} // namespace tetradapt::scene
