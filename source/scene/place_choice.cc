// SPDX-License-Identifier: AGPL-3.0-or-later
#include "place_choice.h"

#include "binder.h"
#include "require.h"

#include "tetradapt/scene/singular_places.h"
#include "tetradapt/scene/words.h"

#include <algorithm>

namespace tetradapt::scene
{
  namespace
  {
    /** What errors would mean with @p which; empty: what they should. */
    std::string
    why_not(const ErrorEstimator which, const std::string &name, const bool is_singular)
    {
      const std::string use
        = " Use residual, spr, averaging, interpolation, degree extrapolation or "
          "local degree extrapolation.";
      switch (which)
        {
        case ErrorEstimator::equilibrated:
          return "equilibrated is a bound of the whole error, and with " + name
                 + ", which acts on single vertices, that is infinite, or the stresses do not "
                   "balance the tractions on faces."
                 + use;
        case ErrorEstimator::goal:
          return "goal needs the solution that the goal's weights cause, which is singular at "
                 + name + " itself." + use;
        case ErrorEstimator::richardson:
          return is_singular ? "richardson extrapolates the energy, which does not converge with "
                                 + name + "." + use
                             : "";
        default:
          return "";
        }
    }
  } // namespace

  void
  bind_place(PlaceParameters &place, const bool has_line, Binder &binder)
  {
    binder("Point",
           place.point,
           optional_point_codec(),
           has_line
             ? "A point of the surface or inside where it holds one vertex, in place of faces: the "
               "mesh gets a vertex there and keeps it. A mesh from a file or of bricks must have "
               "one."
             : "point force: where it acts, on the surface or inside: the mesh gets a vertex there "
               "and keeps it. A mesh from a file or of bricks must have one.");
    if (has_line)
      binder("Line",
             place.line,
             optional_line_codec(),
             "The ends of a straight line on the surface or inside whose edges it holds, in place "
             "of faces: the mesh gets edges there and keeps them.");
    binder("Excluded radius",
           place.excluded_radius,
           optional_number_codec(),
           "Point or line: errors and estimates leave out what is within this distance of it, for "
           "the energy does not converge there; empty: 5 % of the body's largest extent; 0: "
           "nothing, for supports that carry nothing.");
  }

  void
  check_place(const PlaceParameters &place, const Selector &selector, const std::string &path)
  {
    Mistakes mistakes;
    mistakes.require(!place.point || !place.line,
                     path + "/Line",
                     "there is a Point, too. Give one of them; two supports can hold both.");
    if (place.is_set())
      mistakes.require(selector.empty(),
                       path
                         + (!selector.where.empty()    ? "/Where"
                            : !selector.groups.empty() ? "/Groups"
                                                       : "/Boundary ids"),
                       std::string("it acts at a ") + (place.point ? "Point" : "Line")
                         + ", and so on no faces. Give one of them.");
    else
      mistakes.require(!place.excluded_radius,
                       path + "/Excluded radius",
                       "it acts on faces, of which errors leave nothing out. Remove this.");
    if (place.line)
      mistakes.require(place.line->first != place.line->second,
                       path + "/Line",
                       "both ends are the same. Use Point, or correct one of them.");
    if (place.excluded_radius)
      mistakes.require(*place.excluded_radius >= 0.,
                       path + "/Excluded radius",
                       "must be positive, or 0 to leave nothing out; it is "
                         + text_of(*place.excluded_radius) + ".");
    mistakes.throw_together();
  }

  void
  check_point_conditions(const Scene &scene)
  {
    const std::string name = first_place(scene);
    if (name.empty())
      return;
    const std::string singular = first_singular_place(scene);
    Mistakes          mistakes;
    mistakes.require(scene.reference.type != ReferenceParameters::Type::hexahedra,
                     "Reference/Type",
                     "hexahedra have no vertices at points and on lines such as that of " + name
                       + ". Use Type = fine mesh.");
    mistakes.require(singular.empty() || !scene.exact_solution.has_energy(),
                     "Exact solution/Strain energy",
                     "the energy is infinite with " + singular
                       + ". Remove this, or set its Excluded radius = 0 if it is a support that "
                         "carries nothing.");
    const auto check = [&](const ErrorEstimator which, const std::string &path) {
      const std::string text = why_not(which, name, !singular.empty());
      mistakes.require(text.empty(), path, text);
    };
    for (const ErrorEstimator which : scene.estimation.estimators)
      check(which, "Estimation/Estimators");
    if (scene.adaptivity.strategy == AdaptivityParameters::Strategy::adaptive)
      check(scene.adaptivity.refinement_indicator, "Adaptivity/Refinement indicator");
    mistakes.throw_together();
  }
} // namespace tetradapt::scene
