// SPDX-License-Identifier: AGPL-3.0-or-later
#include "consistency.h"

#include "tetradapt/scene/words.h"


namespace tetradapt::scene
{
  namespace
  {
    /** Why a load cannot act on a body that deforms much; empty: it can. */
    std::string
    why_not(const LoadParameters &load)
    {
      switch (load.type)
        {
        case LoadType::pressure:
          return "a pressure follows the surface, which is not available with Formulation = "
                 "finite strain. A traction with nx, ny, nz keeps the direction that it has at "
                 "rest: set Type = traction and, for a pressure p, Value = -p*nx; -p*ny; -p*nz.";
        case LoadType::rotation:
          return "the centrifugal force depends on where the deformed body is, which is not "
                 "available with Formulation = finite strain.";
        case LoadType::temperature:
          return "thermal strain is for small strains only. Set Formulation = displacement and a "
                 "law for small strains.";
        case LoadType::total_force:
          // About makes a couple of tractions, even with a moment of zero.
          return !all_zero(load.total.moment) || load.total.about
                   ? "its tractions keep the direction that they have at rest, so that their "
                     "moment changes as the body deforms. With Formulation = finite strain leave "
                     "out Moment and About."
                   : "";
        default:
          return "";
        }
    }
  } // namespace

  void
  check_finite_strain(const Scene &scene)
  {
    Mistakes mistakes;
    for (const LoadParameters &load : scene.loads)
      {
        const std::string reason = why_not(load);
        mistakes.require(reason.empty(), "Loads/" + load.name + "/Type", reason);
      }
    for (const SupportParameters &support : scene.supports)
      mistakes.require(
        support.type == SupportType::fixed,
        "Supports/" + support.name + "/Type",
        "a support of type '" + word(support.type)
          + "' is for small strains only. With Formulation = finite strain use fixed.");
    const std::string only = " is for small strains only. With Formulation = finite strain ";
    mistakes.require(scene.reference.type == ReferenceParameters::Type::none,
                     "Reference/Type",
                     "a comparison with a reference" + only + "set Type = none.");
    for (const GoalParameters &goal : scene.goals)
      mistakes.require(goal.type == GoalType::point_displacement
                         || goal.type == GoalType::mean_displacement,
                       "Goals/" + goal.name + "/Type",
                       "a goal of stresses" + only + "use a point or mean displacement.");
    for (const ErrorEstimator which : scene.estimation.estimators)
      mistakes.add("Estimation/Estimators",
                   "the estimator '" + word(which) + "'" + only + "leave it out.");
    mistakes.require(!scene.exact_solution.has_displacement() && !scene.exact_solution.has_energy(),
                     "Exact solution",
                     "the comparison with an exact solution" + only + "leave it out.");
    mistakes.require(scene.adaptivity.strategy != AdaptivityParameters::Strategy::adaptive,
                     "Adaptivity/Strategy",
                     "every refinement indicator" + only + "use uniform, mesh list or none.");
    const auto &adapt = scene.adaptivity;
    for (const auto &[name, value] : {std::pair{"Tolerance", adapt.tolerance},
                                      std::pair{"REN tolerance", adapt.ren_tolerance},
                                      std::pair{"Goal tolerance", adapt.goal_tolerance}})
      mistakes.require(value == 0.,
                       std::string("Adaptivity/") + name,
                       "the measurement of errors" + only + "leave it out.");
    mistakes.throw_together();
  }
} // namespace tetradapt::scene
