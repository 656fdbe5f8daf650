// SPDX-License-Identifier: AGPL-3.0-or-later
#include "special_loads.h"

#include "consistency.h"
#include "require.h"

#include "tetradapt/core/surface_expression.h"

namespace tetradapt::scene
{
  namespace
  {
    const std::array<std::string, 3> no_value{{"0", "0", "0"}};

    /** Three texts that must be constants. */
    void
    check_constants(const std::array<std::string, 3> &texts,
                    const std::string                &path,
                    const std::string                &meaning,
                    Mistakes                         &mistakes)
    {
      for (unsigned int c = 0; c < 3; ++c)
        mistakes.attempt([&]() {
          const std::string what = path + ", component " + "xyz"[c];
          require_no_time(texts[c], what);
          core::SurfaceExpression::check(texts[c], what);
          require(core::SurfaceExpression({{texts[c], "0", "0"}}, what).is_constant(),
                  path,
                  "the " + meaning + " of a total force must be three constants, and '" + texts[c]
                    + "' is not one. For a force per area that varies use Type = traction.");
        });
    }

    void
    check_total_force(const LoadParameters &load, const std::string &path, Mistakes &mistakes)
    {
      check_constants(load.value, path + "/Value", "force", mistakes);
      check_constants(load.total.moment, path + "/Moment", "moment", mistakes);
      if (load.total.distribution != Distribution::bearing
          || !mistakes.sound({path + "/Value", path + "/Moment"}))
        return;
      mistakes.require(!all_zero(load.value),
                       path + "/Value",
                       "a force on a bearing must not be zero: it says where the pin presses.");
      mistakes.require(all_zero(load.total.moment),
                       path + "/Moment",
                       "a pin that presses on a bearing causes no moment of its own. Use "
                       "Distribution = even, or another load of type total force for the moment.");
      mistakes.require(!load.total.about,
                       path + "/About",
                       "is for moments, which a pin that presses on a bearing does not cause. "
                       "Leave it out, or use Distribution = even.");
    }

    void
    check_rotation(const LoadParameters &load, const std::string &path, Mistakes &mistakes)
    {
      mistakes.require(
        load.value == no_value,
        path + "/Value",
        "a rotation has none: it is given by Axis point, Axis and Angular velocity.");
      if (mistakes.require(load.rotation.axis.has_value(),
                           path + "/Axis",
                           "give the direction of the axis, such as 0, 0, 1."))
        mistakes.require(load.rotation.axis->norm() > 0.,
                         path + "/Axis",
                         "0, 0, 0 is no direction. Give one such as 0, 0, 1.");
    }

    /** Parameters that only another type of load has. */
    void
    check_foreign(const LoadParameters &load, const std::string &path, Mistakes &mistakes)
    {
      const std::string a = "a " + word(load.type) + " has none. ";
      const auto        refuse
        = [&](const bool is_given, const std::string &name, const std::string &cure) {
            mistakes.require(!is_given, path + "/" + name, a + cure);
          };
      if (load.type != LoadType::total_force)
        {
          const std::string cure
            = acts_on_faces(load.type)
                ? "For a force and a moment of the whole selection use Type = total force."
                : "It belongs to Type = total force, which acts on faces.";
          refuse(load.total.moment != no_value, "Moment", cure);
          refuse(load.total.about.has_value(), "About", cure);
          refuse(load.total.distribution != Distribution::even, "Distribution", cure);
        }
      if (load.type != LoadType::rotation)
        {
          const std::string cure
            = "For the centrifugal force of a body that turns use Type = rotation.";
          refuse(load.rotation.axis.has_value(), "Axis", cure);
          refuse(load.rotation.axis_point != dealii::Point<3>(), "Axis point", cure);
          refuse(load.rotation.angular_velocity != 0., "Angular velocity", cure);
        }
      if (load.type == LoadType::total_force || load.type == LoadType::rotation
          || load.type == LoadType::nodal_force || load.type == LoadType::point_force)
        refuse(
          load.smallest_feature != 0.,
          "Smallest feature",
          "It is for loads whose Value is integrated: traction, pressure, body force, gravity, "
          "temperature.");
    }
  } // namespace

  void
  bind_special_loads(LoadParameters &p, Binder &binder)
  {
    binder("Moment",
           p.total.moment,
           expressions_codec<3>(false),
           "total force: the moment about the point About, three constants separated by "
           "semicolons.");
    binder("About",
           p.total.about,
           optional_point_codec(),
           "total force: the point that Moment refers to; empty: the centroid of the selected "
           "faces of the present mesh.");
    binder(
      "Distribution",
      p.total.distribution,
      word_codec<Distribution>(),
      "total force: how it is spread. even: a traction a + b x (x - c), c the faces' "
      "centroid, constant if there is no moment about it; bearing: a pressure as of a pin in a "
      "hole or of a bearing on a shaft, proportional to the cosine between the force and "
      "the inward normal where that is positive.");
    binder("Axis point", p.rotation.axis_point, point_codec(), "rotation: a point on the axis.");
    binder("Axis",
           p.rotation.axis,
           optional_point_codec(),
           "rotation: the direction of the axis, of any length.");
    binder("Angular velocity",
           p.rotation.angular_velocity,
           number_codec(),
           "rotation: radians per unit of time, the one that is in the unit of Density. The sign "
           "does not matter.");
  }

  void
  check_special_load(const LoadParameters &load, Mistakes &mistakes)
  {
    const std::string path = "Loads/" + load.name;
    if (load.type == LoadType::total_force)
      check_total_force(load, path, mistakes);
    if (load.type == LoadType::rotation)
      check_rotation(load, path, mistakes);
    check_foreign(load, path, mistakes);
  }

  std::string
  zero_parameter(const LoadParameters &load)
  {
    if (load.type == LoadType::rotation)
      return load.rotation.angular_velocity == 0. ? "Angular velocity" : "";
    if (!all_zero(load.value)
        || (load.type == LoadType::total_force && !all_zero(load.total.moment)))
      return "";
    return "Value";
  }
} // namespace tetradapt::scene
