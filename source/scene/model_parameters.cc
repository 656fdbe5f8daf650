// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/model_parameters.h"
#include "tetradapt/laws/law_catalogue.h"

#include "binder.h"
#include "face_choice.h"
#include "place_choice.h"
#include "require.h"
#include "special_loads.h"
#include "spring_supports.h"
#include "support_types.h"

#include "tetradapt/core/surface_expression.h"
#include "tetradapt/scene/nearest_names.h"

#include <algorithm>

namespace tetradapt::scene
{
  namespace
  {
    const char *region_note = "Both lists empty: ";

    /** Which laws have the constant @p name. */
    std::string
    users_of(const std::string &name)
    {
      std::string users;
      for (const laws::LawEntry &law : laws::law_catalogue())
        for (const laws::Constant &constant : law.constants)
          if (constant.name == name)
            users += (users.empty() ? "" : ", ") + law.name;
      return users;
    }

    /** The constants of all laws. Those that are not set are those of the law only. */
    void
    bind_constants(MaterialParameters &p, Binder &binder)
    {
      for (const laws::Constant &constant : laws::all_constants())
        {
          std::optional<double> value;
          if (const auto given = p.constants.find(constant.name); given != p.constants.end())
            value = given->second;
          binder(constant.name,
                 value,
                 optional_number_codec(),
                 constant.documentation + " Of " + users_of(constant.name)
                   + "; empty: " + text_of(constant.standard) + ".");
          if (value)
            p.constants[constant.name] = *value;
        }
    }

    void
    bind(MaterialParameters &p, Binder &binder)
    {
      std::string names, texts;
      for (const laws::LawEntry &law : laws::law_catalogue())
        {
          names += (names.empty() ? "" : ", ") + law.name;
          texts += (texts.empty() ? "" : "; ") + law.name + ": " + law.documentation;
        }
      binder("Law", p.law, text_codec("one of: " + names), "Constitutive law. " + texts + ".");
      binder("Regions",
             p.regions,
             ids_codec(),
             std::string("Ids of the regions that it fills. ") + region_note
               + "all that no other material names.");
      binder("Region groups",
             p.region_groups,
             names_codec(),
             "Names of regions that it fills, where the mesh file has names.");
      bind_constants(p, binder);
      binder("Density",
             p.density,
             number_codec(),
             "Mass per volume; used by gravity and rotation.");
      binder("Thermal expansion",
             p.thermal_expansion,
             number_codec(),
             "Strain per degree; used by temperature.");
    }

    void
    bind_faces(Selector &selector, Binder &binder)
    {
      binder("Boundary ids",
             selector.ids,
             ids_codec(),
             "Boundary ids of the faces that it holds on.");
      binder("Groups",
             selector.groups,
             names_codec(),
             "Names of such groups of faces, for a box: x-min, x-max, y-min, ... A face counts "
             "if its id or its group is listed, or if neither list is given.");
      bind_where(selector, binder);
    }

    void
    bind(SupportParameters &p, Binder &binder)
    {
      bind_support_type(p, binder);
      bind_faces(p.selector, binder);
      bind_place(p.place, true, binder);
      std::array<bool, 3> components
        = p.type == SupportType::spring ? SupportParameters().components : p.components;
      binder("Components",
             components,
             components_codec(),
             "fixed: components of the displacement that are prescribed: all, or some of x, y, z.");
      binder(
        "Displacement",
        p.displacement,
        expressions_codec<3>(false),
        "fixed: prescribed displacement: three expressions in x, y, z, separated by semicolons; "
        "spring: the displacement u0 of the ground under the springs.");
      bind_special_support(p, binder);
      bind_spring(p, components, binder);
    }

    bool
    is_scalar(const LoadType type)
    {
      return type == LoadType::pressure || type == LoadType::temperature;
    }

    void
    bind(LoadParameters &p, Binder &binder)
    {
      binder("Type",
             p.type,
             word_codec<LoadType>(),
             "traction: force per area; pressure: force per area against the outer normal; total "
             "force: the force, and a Moment, of the whole selection; nodal "
             "force: a force at every mesh point of the faces, so that the whole load grows with "
             "the mesh (for comparison with programs that do this); body force: force per volume; "
             "gravity: an acceleration, times the density; rotation: the centrifugal force of a "
             "body that turns about an axis, by its density; "
             "temperature: its change, which causes thermal strain; point force: a force at one "
             "Point, where the energy does not converge.");
      const bool on_faces = acts_on_faces(p.type);
      Selector   faces    = on_faces ? p.selector : Selector();
      Selector   regions  = on_faces ? Selector() : p.selector;
      bind_faces(faces, binder);
      binder("Regions",
             regions.ids,
             ids_codec(),
             std::string("body force, gravity, rotation, temperature: ids of regions. ")
               + region_note + "everywhere.");
      binder("Region groups",
             regions.groups,
             names_codec(),
             "body force, gravity, rotation, temperature: names of regions.");

      bind_place(p.place, false, binder);

      std::vector<std::string> values(p.value.begin(), p.value.end());
      if (is_scalar(p.type))
        values.resize(1);
      binder("Value",
             values,
             value_codec(),
             "Expressions in x, y, z: three separated by semicolons for a vector, one for a "
             "pressure or a temperature; a total force: three constants; a rotation: none. A "
             "traction or a pressure may also use nx, ny, nz, the "
             "unit normal that points out of the body: that of the surface which Mesh/Projection "
             "names at the nearest point, else that of the face of the mesh.");
      binder("Smallest feature",
             p.smallest_feature,
             number_codec(),
             "Size of the smallest thing that Value may show, such as a peak or a patch. Value is "
             "looked at with this spacing on every mesh before it is integrated; 0: a "
             "hundredth of the body's diagonal.");
      bind_special_loads(p, binder);
      if (!binder.parsing())
        return;

      // The type was read above, so that only now its lists are known.
      const std::string path = "Loads/" + p.name + "/";
      if (p.type == LoadType::point_force)
        {
          require(faces.empty() && regions.empty(),
                  path
                    + (!faces.ids.empty()      ? "Boundary ids"
                       : !faces.groups.empty() ? "Groups"
                       : !faces.where.empty()  ? "Where"
                       : !regions.ids.empty()  ? "Regions"
                                               : "Region groups"),
                  "a point force acts at its Point only. Remove this.");
          p.selector = faces;
        }
      else if (acts_on_faces(p.type))
        {
          require(regions.empty(),
                  path + (regions.ids.empty() ? "Region groups" : "Regions"),
                  "a " + word(p.type)
                    + " acts on faces: choose them by Boundary ids, Groups or Where.");
          p.selector = faces;
        }
      else
        {
          require(faces.empty(),
                  path
                    + (!faces.ids.empty()      ? "Boundary ids"
                       : !faces.groups.empty() ? "Groups"
                                               : "Where"),
                  "a " + word(p.type) + " acts on the volume: choose it by Regions or Region groups"
                    + (p.type == LoadType::rotation
                         ? "."
                         : ", or make the value depend on x, y, z with if(condition, value, 0)."));
          p.selector = regions;
        }
      const bool        untouched = values == std::vector<std::string>{"0", "0", "0"};
      const std::size_t wanted    = is_scalar(p.type) ? 1 : 3;
      require(values.size() == wanted || untouched,
              path + "Value",
              "a " + word(p.type) + " needs "
                + (wanted == 1 ? "one expression" : "three expressions separated by semicolons")
                + ", not " + std::to_string(values.size()) + ".");
      p.value.fill("0");
      std::copy(values.begin(), values.end(), p.value.begin());
    }

    void
    bind(ExactSolutionParameters &p, Binder &binder)
    {
      binder("Displacement",
             p.displacement,
             expressions_codec<3>(true),
             "Exact displacement: three expressions in x, y, z, separated by semicolons; empty: "
             "unknown.");
      binder("Gradient",
             p.gradient,
             expressions_codec<9>(true),
             "Its derivatives du_x/dx; du_x/dy; du_x/dz; du_y/dx; ...; empty: by differences.");
      binder("Strain energy",
             p.strain_energy,
             number_codec(),
             "Its strain energy, half the integral of strain : C : strain, without thermal strain: "
             "the column strain_energy of the tables, and half the work of the loads if they act "
             "alone; 0: unknown.");
    }
  } // namespace

  bool
  acts_on_surface(const LoadType type)
  {
    return type == LoadType::traction || type == LoadType::pressure
           || type == LoadType::total_force;
  }

  bool
  acts_on_faces(const LoadType type)
  {
    return acts_on_surface(type) || type == LoadType::nodal_force;
  }

  namespace
  {
    std::string
    names_of(const laws::Constants &constants)
    {
      std::string names;
      for (const auto &constant : constants)
        names += (names.empty() ? "" : ", ") + constant.first;
      return names;
    }

    /** @throws core::InputError or SeveralMistakes */
    void
    check_law(const MaterialParameters &material)
    {
      const std::string        path = "Materials/" + material.name + "/";
      Mistakes                 mistakes;
      std::vector<std::string> laws;
      for (const laws::LawEntry &entry : laws::law_catalogue())
        laws.push_back(entry.name);
      if (!mistakes.require(std::count(laws.begin(), laws.end(), material.law) > 0,
                            path + "Law",
                            "there is no law '" + material.law + "'. "
                              + suggest(material.law, laws)))
        mistakes.throw_together();
      try
        {
          const laws::Constants values = laws::values_of(material.law, material.constants);
          for (const auto &given : material.constants)
            mistakes.require(values.count(given.first) > 0,
                             path + given.first,
                             "the law '" + material.law + "' has no such constant. It has "
                               + names_of(values) + ".");
          for (const laws::Constant &constant : laws::find_law(material.law).constants)
            {
              const double      value   = values.at(constant.name);
              const std::string mistake = constant.mistake(value);
              mistakes.require(mistake.empty(),
                               path + constant.name,
                               mistake + ", not " + text_of(value) + ".");
            }
          if (mistakes.empty())
            laws::make_law(material.law, material.constants);
        }
      catch (const core::InputError &error)
        {
          mistakes.add(path + "Law", error.what());
        }
      mistakes.throw_together();
    }
  } // namespace

  laws::ModuliAtRest
  MaterialParameters::moduli_at_rest() const
  {
    return laws::make_law(law, constants)->moduli_at_rest();
  }

  void
  MaterialParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  MaterialParameters::parse(dealii::ParameterHandler &prm)
  {
    constants.clear();
    parse_bound(*this, prm, bind);
    // Those that are not given; check() tells of an unknown law.
    for (const laws::LawEntry &entry : laws::law_catalogue())
      if (entry.name == law)
        for (const auto &value : laws::values_of(law, constants))
          constants.insert(value);
  }

  void
  MaterialParameters::check() const
  {
    Mistakes          mistakes;
    const std::string path = "Materials/" + name + "/";
    mistakes.require(!law.empty(), path + "Law", "give the name of a law, such as linear elastic.");
    if (!law.empty())
      mistakes.attempt([&]() { check_law(*this); });
    mistakes.require(density >= 0.,
                     path + "Density",
                     "must not be negative; it is " + text_of(density) + ".");
    mistakes.throw_together();
  }

  void
  SupportParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  SupportParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  void
  SupportParameters::check() const
  {
    Mistakes          mistakes;
    const std::string path = "Supports/" + name;
    if (place.is_set() || place.excluded_radius)
      mistakes.attempt([&]() { check_place(place, selector, path); });
    if (!place.is_set())
      mistakes.attempt([&]() { check_faces(selector, path); });
    check_special_support(*this, mistakes);
    check_spring(*this, mistakes);
    mistakes.require(type == SupportType::spring || components[0] || components[1] || components[2],
                     path + "/Components",
                     "name at least one of x, y, z, or all.");
    for (unsigned int c = 0; c < 3; ++c)
      {
        const std::string letter(1, "xyz"[c]);
        const std::string what     = path + "/Displacement, component " + letter;
        double            value    = 0.;
        bool              constant = false;
        if (mistakes.attempt([&]() { constant = constant_value(displacement[c], what, value); }))
          mistakes.require(type == SupportType::spring || components[c]
                             || (constant && value == 0.),
                           path + "/Displacement",
                           "it prescribes the component " + letter + " ('" + displacement[c]
                             + "'), which Components leaves free. Add " + letter
                             + " to Components, or write 0 for it.");
      }
    mistakes.throw_together();
  }

  void
  LoadParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  LoadParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  void
  LoadParameters::check() const
  {
    Mistakes          mistakes;
    const std::string path = "Loads/" + name;
    if (acts_on_faces(type))
      mistakes.attempt([&]() { check_faces(selector, path); });
    mistakes.require(smallest_feature >= 0.,
                     path + "/Smallest feature",
                     "must be positive, or 0 for a hundredth of the body's size; it is "
                       + text_of(smallest_feature) + ".");
    if (type == LoadType::point_force)
      {
        mistakes.require(place.is_set(),
                         path + "/Point",
                         "a point force needs the point that it acts at, such as 0, 0, 1.5.");
        if (place.is_set())
          mistakes.attempt([&]() { check_place(place, selector, path); });
      }
    else
      {
        mistakes.require(!place.is_set(),
                         path + "/Point",
                         "only a point force acts at a point. Set Type = point force, or remove "
                         "this.");
        mistakes.require(!place.excluded_radius,
                         path + "/Excluded radius",
                         "only a point force has one. Remove this.");
      }
    check_special_load(*this, mistakes);
    const bool         has_normal = type == LoadType::traction || type == LoadType::pressure;
    const unsigned int n_values   = type == LoadType::total_force || type == LoadType::rotation ? 0
                                    : is_scalar(type)                                           ? 1
                                                                                                : 3;
    for (unsigned int c = 0; c < n_values; ++c)
      mistakes.attempt([&]() {
        const std::string what
          = path + "/Value" + (is_scalar(type) ? "" : std::string(", component ") + "xyz"[c]);
        require_no_time(value[c], what);
        if (has_normal)
          core::SurfaceExpression::check(value[c], what);
        else
          check_expression(value[c], what);
      });
    mistakes.throw_together();
  }

  void
  ExactSolutionParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  ExactSolutionParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  void
  ExactSolutionParameters::check() const
  {
    Mistakes mistakes;
    if (has_displacement())
      for (unsigned int c = 0; c < 3; ++c)
        mistakes.attempt([&]() {
          check_expression(displacement[c],
                           std::string("Exact solution/Displacement, component ") + "xyz"[c]);
        });
    mistakes.require(
      has_displacement() || !has_gradient(),
      "Exact solution/Gradient",
      "the gradient of an unknown displacement. Give Exact solution/Displacement too.");
    if (has_gradient())
      for (unsigned int i = 0; i < 9; ++i)
        mistakes.attempt([&]() {
          check_expression(gradient[i],
                           std::string("Exact solution/Gradient, du_") + "xyz"[i / 3] + "/d"
                             + "xyz"[i % 3]);
        });
    mistakes.require(strain_energy >= 0.,
                     "Exact solution/Strain energy",
                     "must be positive, or 0 if it is unknown; it is " + text_of(strain_energy)
                       + ".");
    mistakes.throw_together();
  }
} // namespace tetradapt::scene
