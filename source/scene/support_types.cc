// SPDX-License-Identifier: AGPL-3.0-or-later
#include "support_types.h"

#include "consistency.h"
#include "require.h"

#include "tetradapt/core/expression.h"
#include "tetradapt/scene/moved_supports.h"
#include "tetradapt/scene/words.h"

#include <algorithm>

namespace tetradapt::scene
{
  namespace
  {
    const SupportParameters none;

    using E = ErrorEstimator;

    /** The estimators that do not know a type of support. */
    const std::vector<E> not_for_sliding{E::equilibrated};
    const std::vector<E> not_for_rigid{E::equilibrated,
                                       E::degree_extrapolation,
                                       E::local_degree_extrapolation,
                                       E::goal};

    /** Three constants; @p free are the components of the motion on which they may act. */
    void
    check_constants(const std::array<std::string, 3> &texts,
                    const RigidParameters::Motion    &motion,
                    const std::string                &path,
                    const std::string                &motion_name,
                    Mistakes                         &mistakes)
    {
      for (unsigned int c = 0; c < 3; ++c)
        mistakes.attempt([&]() {
          double value = 0.;
          require(constant_value(texts[c], path + ", component " + "xyz"[c], value),
                  path,
                  "must be three constants, and '" + texts[c] + "' is not one.");
          require(value == 0. || !motion[c],
                  path,
                  std::string("it acts on the component ") + "xyz"[c] + ", which " + motion_name
                    + " prescribes, so that it would deform nothing. Write free there, or 0 here.");
        });
    }

    void
    check_sliding(const SupportParameters &support, const std::string &path, Mistakes &mistakes)
    {
      mistakes.attempt(
        [&]() { check_expression(support.normal_displacement, path + "/Normal displacement"); });
      mistakes.require(!support.place.is_set(),
                       path + (support.place.point ? "/Point" : "/Line"),
                       "a point or a line has no normal to slide across. Use Type = fixed there.");
    }

    void
    check_rigid(const SupportParameters &support, const std::string &path, Mistakes &mistakes)
    {
      mistakes.require(!support.place.is_set(),
                       path + (support.place.point ? "/Point" : "/Line"),
                       "a point or a line cannot be coupled rigidly. Choose faces.");
      check_constants(
        support.rigid.force, support.rigid.translation, path + "/Force", "Translation", mistakes);
      check_constants(
        support.rigid.moment, support.rigid.rotation, path + "/Moment", "Rotation", mistakes);
    }

    /** Adds a mistake for each thing that the scene asks for and a support of this type does not
     * allow. */
    void
    check_uses(const Scene                       &scene,
               const SupportParameters           &support,
               const std::vector<ErrorEstimator> &not_for,
               Mistakes                          &mistakes)
    {
      const std::string what = "Supports/" + support.name + ", of type " + word(support.type);
      mistakes.require(scene.formulation != Formulation::mixed,
                       "Formulation",
                       "the mixed form has no " + word(support.type)
                         + " supports, and there is Supports/" + support.name
                         + ". Use Formulation = displacement.");
      mistakes.require(scene.reference.type != ReferenceParameters::Type::hexahedra,
                       "Reference/Type",
                       "hexahedra cannot be held by " + what + ". Use Type = fine mesh.");
      const auto check = [&](const ErrorEstimator which, const std::string &path) {
        mistakes.require(std::count(not_for.begin(), not_for.end(), which) == 0,
                         path,
                         "the estimator '" + word(which) + "' does not know what " + what
                           + ", does. Use spr, averaging, residual or another one that does (see "
                             "doc/supports.md).");
      };
      for (const ErrorEstimator which : scene.estimation.estimators)
        check(which, "Estimation/Estimators");
      if (scene.adaptivity.strategy == AdaptivityParameters::Strategy::adaptive)
        check(scene.adaptivity.refinement_indicator, "Adaptivity/Refinement indicator");
    }
  } // namespace

  void
  bind_support_type(SupportParameters &p, Binder &binder)
  {
    binder("Type",
           p.type,
           word_codec<SupportType>(),
           "fixed: prescribes components of the displacement; sliding: the displacement along the "
           "normal of the faces is Normal displacement, and they slide freely; rigid: the faces "
           "move like a rigid body with a reference point, which can be moved and loaded; spring: "
           "an elastic foundation on faces, whose traction on the body is -k (u - u0).");
  }

  void
  bind_special_support(SupportParameters &p, Binder &binder)
  {
    binder("Normal displacement",
           p.normal_displacement,
           text_codec("an expression"),
           "sliding: the displacement along the outer normal, an expression in x, y, z. The "
           "normal is that of the surface which Mesh/Projection names, else a mean of the faces "
           "around a node which meet at less than Mesh/Feature angle.");
    binder("Reference point",
           p.rigid.reference_point,
           optional_point_codec(),
           "rigid: the point that Translation, Force and Moment refer to; empty: the centroid of "
           "the faces of the present mesh.");
    binder("Translation",
           p.rigid.translation,
           motion_codec(),
           "rigid: the displacement of the reference point: three components separated by commas, "
           "each a number or free.");
    binder("Rotation",
           p.rigid.rotation,
           motion_codec(),
           "rigid: the rotation of the faces, in radians about the axes x, y and z through the "
           "reference point: three components separated by commas, each a number or free. It is "
           "small: a point at r from the reference point moves by R x r.");
    binder("Force",
           p.rigid.force,
           expressions_codec<3>(false),
           "rigid: a force at the reference point, three constants separated by semicolons; where "
           "Translation is free.");
    binder("Moment",
           p.rigid.moment,
           expressions_codec<3>(false),
           "rigid: a moment about the reference point, three constants separated by semicolons; "
           "where Rotation is free.");
  }

  void
  check_special_support(const SupportParameters &support, Mistakes &mistakes)
  {
    const std::string path   = "Supports/" + support.name;
    const auto        refuse = [&](const bool set, const std::string &name, SupportType type) {
      mistakes.require(!set || support.type == type,
                       path + "/" + name,
                       "is for supports of type " + word(type) + ", and this one is "
                         + word(support.type) + ". Remove it, or set Type = " + word(type) + ".");
    };
    // Springs have no components and look at theirs themselves; their Displacement is the ground's.
    if (support.type != SupportType::spring)
      {
        refuse(support.components != none.components, "Components", SupportType::fixed);
        refuse(support.displacement != none.displacement, "Displacement", SupportType::fixed);
      }
    refuse(support.normal_displacement != none.normal_displacement,
           "Normal displacement",
           SupportType::sliding);
    const RigidParameters &rigid = support.rigid;
    refuse(rigid.reference_point.has_value(), "Reference point", SupportType::rigid);
    refuse(rigid.translation != none.rigid.translation, "Translation", SupportType::rigid);
    refuse(rigid.rotation != none.rigid.rotation, "Rotation", SupportType::rigid);
    refuse(rigid.force != none.rigid.force, "Force", SupportType::rigid);
    refuse(rigid.moment != none.rigid.moment, "Moment", SupportType::rigid);
    if (support.type == SupportType::sliding)
      check_sliding(support, path, mistakes);
    if (support.type == SupportType::rigid)
      check_rigid(support, path, mistakes);
  }

  bool
  may_hold(const SupportParameters &support, const unsigned int c)
  {
    switch (support.type)
      {
      case SupportType::sliding:
      case SupportType::spring:
        return true;
      case SupportType::rigid:
        return support.rigid.translation[c] || support.rigid.rotation[(c + 1) % 3]
               || support.rigid.rotation[(c + 2) % 3];
      default:
        return support.components[c];
      }
  }

  bool
  loads_supports(const Scene &scene)
  {
    return std::any_of(
      scene.supports.begin(), scene.supports.end(), [](const SupportParameters &support) {
        return support.type == SupportType::rigid
               && (!all_zero(support.rigid.force) || !all_zero(support.rigid.moment));
      });
  }

  void
  check_support_types(const Scene &scene)
  {
    Mistakes mistakes;
    for (const auto &support : scene.supports)
      {
        if (support.type == SupportType::sliding)
          {
            check_uses(scene, support, not_for_sliding, mistakes);
            mistakes.require(scene.mesh.feature_angle > 0. && scene.mesh.feature_angle <= 180.,
                             "Mesh/Feature angle",
                             "must be between 0 and 180 degrees; 60 is usual.");
          }
        if (support.type != SupportType::rigid)
          continue;
        check_uses(scene, support, not_for_rigid, mistakes);
        mistakes.require(scene.solver.multigrid != SolverParameters::Multigrid::trilinos,
                         "Solver/Multigrid",
                         "Trilinos' multigrid cannot couple faces rigidly, as Supports/"
                           + support.name + " does. Remove this.");
      }
    mistakes.throw_together();
  }
} // namespace tetradapt::scene
