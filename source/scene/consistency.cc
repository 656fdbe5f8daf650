// SPDX-License-Identifier: AGPL-3.0-or-later
#include "consistency.h"

#include "require.h"
#include "values.h"

#include "tetradapt/core/surface_expression.h"
#include "tetradapt/scene/words.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::scene
{
  std::string
  energy_estimator(const Scene &scene)
  {
    // What is left out needs a reference or an exact solution, or is no energy norm.
    const auto tells_energy = [](const ErrorEstimator which) {
      return which != ErrorEstimator::energy && which != ErrorEstimator::ren
             && which != ErrorEstimator::exact && which != ErrorEstimator::goal;
    };
    const auto &adapt = scene.adaptivity;
    if (adapt.strategy == AdaptivityParameters::Strategy::adaptive
        && tells_energy(adapt.refinement_indicator))
      return word(adapt.refinement_indicator);
    for (const ErrorEstimator which : scene.estimation.estimators)
      if (tells_energy(which))
        return word(which);
    return "";
  }

  bool
  all_zero(const std::array<std::string, 3> &expressions)
  {
    // Those of loads may name the normal.
    const core::SurfaceExpression value(expressions, "value");
    return value.is_constant()
           && value(core::Point<3>(), core::Tensor<1, 3>()) == core::Tensor<1, 3>();
  }

  bool
  any_material(const Scene                                           &scene,
               const LoadParameters                                  &load,
               const std::function<bool(const MaterialParameters &)> &property)
  {
    for (const auto &material : scene.materials)
      {
        // Whether one of the lists is empty, or they share an element.
        bool acts
          = load.selector.empty() || (material.regions.empty() && material.region_groups.empty());
        for (const int id : load.selector.ids)
          acts = acts || !material.region_groups.empty()
                 || std::count(material.regions.begin(), material.regions.end(), id) > 0;
        for (const auto &group : load.selector.groups)
          acts = acts || !material.regions.empty()
                 || std::count(material.region_groups.begin(), material.region_groups.end(), group)
                      > 0;
        if (acts && property(material))
          return true;
      }
    return false;
  }

  bool
  expands(const Scene &scene, const LoadParameters &load)
  {
    return any_material(scene, load, [](const MaterialParameters &material) {
      return material.thermal_expansion != 0.;
    });
  }

  void
  check_compatible(const SupportParameters &first, const SupportParameters &second)
  {
    // What meets at a vertex is compared where it is known.
    if (first.place.is_set() || second.place.is_set())
      return;
    if (first.selector.ids != second.selector.ids || first.selector.groups != second.selector.groups
        || first.selector.where != second.selector.where)
      return;
    if (first.type == SupportType::spring || second.type == SupportType::spring)
      return;
    require(first.type == second.type
              || (first.type != SupportType::rigid && second.type != SupportType::rigid),
            "Supports/" + second.name + "/Type",
            "the support '" + first.name
              + "' holds the same faces, and one of them couples these rigidly to a reference "
                "point. Choose other faces for one of them.");
    require(first.type != SupportType::rigid || second.type != SupportType::rigid,
            "Supports/" + second.name,
            "the support '" + first.name
              + "' couples the same faces to a reference point. Use one of them.");
    if (first.type == SupportType::sliding && second.type == SupportType::sliding)
      require(first.normal_displacement == second.normal_displacement,
              "Supports/" + second.name + "/Normal displacement",
              "it is '" + second.normal_displacement + "' on the same faces for which the support '"
                + first.name + "' has '" + first.normal_displacement + "'. Change one of them.");
    if (first.type != SupportType::fixed || second.type != SupportType::fixed)
      return;
    for (unsigned int c = 0; c < 3; ++c)
      if (first.components[c] && second.components[c])
        require(first.displacement[c] == second.displacement[c],
                "Supports/" + second.name + "/Displacement",
                std::string("it prescribes the component ") + "xyz"[c]
                  + " on the same faces as the support '" + first.name + "', but to '"
                  + second.displacement[c] + "' instead of '" + first.displacement[c]
                  + "'. Change one of them.");
  }

  namespace
  {
    /** du/dx_d by a difference of order four, and the error that its rounding may
     * have. NaN where the displacement has no value. */
    double
    difference(const core::Expression &u,
               const core::Point<3>   &p,
               const unsigned int      d,
               const double            step)
    {
      const auto at = [&](const double distance) {
        core::Point<3> q = p;
        q[d] += distance;
        try
          {
            return u(q);
          }
        catch (const core::InputError &)
          {
            return std::nan("");
          }
      };
      return (8. * (at(step) - at(-step)) - (at(2. * step) - at(-2. * step))) / (12. * step);
    }

    /** Six digits of @p value. */
    std::string
    short_text(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }

    double
    value_or_nan(const core::Expression &expression, const core::Point<3> &p)
    {
      try
        {
          return expression(p);
        }
      catch (const core::InputError &)
        {
          return std::nan("");
        }
    }
  } // namespace

  void
  check_exact_gradient(const Scene &scene)
  {
    const auto &mesh = scene.mesh;
    if (!scene.exact_solution.has_gradient()
        || (mesh.source != MeshSource::box && mesh.source != MeshSource::bricks))
      return;
    const dealii::Tensor<1, 3> size = mesh.upper_corner - mesh.lower_corner;
    // Points inside, none of them on a symmetry plane of the box.
    const std::array<std::array<double, 3>, 3> fractions{
      {{{.313, .621, .457}}, {{.717, .239, .881}}, {{.141, .843, .269}}}};
    for (const auto &fraction : fractions)
      {
        core::Point<3> p = mesh.lower_corner;
        for (unsigned int d = 0; d < 3; ++d)
          p[d] += fraction[d] * size[d];
        std::array<double, 9> given, expected;
        double                largest = 0.;
        for (unsigned int i = 0; i < 9; ++i)
          {
            const core::Expression u(scene.exact_solution.displacement[i / 3],
                                     "Exact solution/Displacement");
            const core::Expression g(scene.exact_solution.gradient[i], "Exact solution/Gradient");
            given[i]    = value_or_nan(g, p);
            expected[i] = difference(u, p, i % 3, 1e-3 * size[i % 3]);
            if (std::isfinite(expected[i]))
              largest = std::max({largest, std::abs(expected[i]), std::abs(given[i])});
          }
        for (unsigned int i = 0; i < 9; ++i)
          if (std::isfinite(given[i]) && std::isfinite(expected[i]))
            require(std::abs(given[i] - expected[i]) <= 1e-3 * largest,
                    "Exact solution/Gradient",
                    std::string("du_") + "xyz"[i / 3] + "/d" + "xyz"[i % 3] + " = "
                      + scene.exact_solution.gradient[i] + " is " + short_text(given[i]) + " at ("
                      + text_of(p[0]) + ", " + text_of(p[1]) + ", " + text_of(p[2])
                      + "), but differences of Exact solution/Displacement give "
                      + short_text(expected[i]) + ". Correct it, or leave Gradient empty.");
      }
  }
} // namespace tetradapt::scene
