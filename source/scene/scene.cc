// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/scene.h"

#include "tetradapt/scene/moved_supports.h"
#include "tetradapt/scene/words.h"

#include "consistency.h"
#include "place_choice.h"
#include "require.h"
#include "special_loads.h"
#include "spring_supports.h"
#include "support_types.h"
#include "values.h"

#include <algorithm>
#include <set>

namespace tetradapt::scene
{
  namespace
  {
    void
    check_materials(const Scene &scene)
    {
      Mistakes mistakes;
      mistakes.require(
        !scene.materials.empty(),
        "Materials",
        "the scene has no material. Add one, such as: subsection Materials, subsection "
        "tissue, set Young modulus = 1000, end, end.");
      std::map<int, std::string>         owner_of_region;
      std::map<std::string, std::string> owner_of_group;
      std::string                        owner_of_rest;
      for (const auto &material : scene.materials)
        {
          const std::string path = "Materials/" + material.name;
          for (const int region : material.regions)
            {
              const auto [entry, is_new] = owner_of_region.emplace(region, material.name);
              mistakes.require(is_new,
                               path + "/Regions",
                               "region " + std::to_string(region)
                                 + " already belongs to the material '" + entry->second
                                 + "'. Name it once.");
            }
          for (const auto &group : material.region_groups)
            {
              const auto [entry, is_new] = owner_of_group.emplace(group, material.name);
              mistakes.require(is_new,
                               path + "/Region groups",
                               "'" + group + "' already belongs to the material '" + entry->second
                                 + "'. Name it once.");
            }
          if (material.regions.empty() && material.region_groups.empty())
            {
              mistakes.require(
                owner_of_rest.empty(),
                path,
                "neither this material nor '" + owner_of_rest
                  + "' names regions, so that both would fill all others. Set Regions or "
                    "Region groups in one of them.");
              owner_of_rest = material.name;
            }
        }
      mistakes.throw_together();
    }

    void
    check_supports(const Scene &scene)
    {
      Mistakes mistakes;
      require(!scene.supports.empty(),
              "Supports",
              "the scene has no support, so that the body can move freely. Add one, such as: "
              "subsection Supports, subsection foot, set Where = z < 1e-9, end, end.");
      std::array<bool, 3> held{{false, false, false}};
      for (const auto &support : scene.supports)
        {
          for (unsigned int c = 0; c < 3; ++c)
            held[c] = held[c] || may_hold(support, c);
        }
      for (unsigned int c = 0; c < 3; ++c)
        mistakes.require(held[c],
                         "Supports",
                         std::string("no support holds the component ") + "xyz"[c]
                           + ", so that the body can move freely in this direction. Add " + "xyz"[c]
                           + " to the Components of a support.");
      for (std::size_t i = 0; i < scene.supports.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          mistakes.attempt([&]() { check_compatible(scene.supports[j], scene.supports[i]); });
      mistakes.throw_together();
    }

    void
    check_loads(const Scene &scene)
    {
      Mistakes mistakes;
      for (const auto &load : scene.loads)
        {
          if (load.type == LoadType::gravity || load.type == LoadType::rotation)
            mistakes.require(
              any_material(scene, load, [](const MaterialParameters &m) { return m.density > 0.; }),
              "Loads/" + load.name + "/Type",
              word(load.type)
                + " needs a density, and that of every material it acts on is 0. Set "
                  "Density in Materials/"
                + scene.materials[0].name + ".");
        }
      bool anything = false;
      for (const auto &load : scene.loads)
        anything = anything
                   || (zero_parameter(load).empty()
                       && (load.type != LoadType::temperature || expands(scene, load)));
      anything = anything || moves_supports(scene) || loads_supports(scene);
      mistakes.require(
        anything,
        "Loads",
        "nothing deforms the body: there is no load with a value and no prescribed "
        "displacement other than 0. Add a load, such as: subsection Loads, subsection "
        "tip, set Where = x > 9.9, set Value = 0; 0; -1, end, end.");
      mistakes.throw_together();
    }

    void
    check_reference(const Scene &scene)
    {
      Mistakes mistakes;
      using Reference = ReferenceParameters;
      mistakes.require(scene.reference.type != Reference::Type::hexahedra
                         || scene.mesh.source == MeshSource::box
                         || scene.mesh.source == MeshSource::bricks
                         || scene.mesh.source == MeshSource::blocks,
                       "Reference/Type",
                       "hexahedra fill bodies made of boxes only, but the scene's mesh is a "
                         + word(scene.mesh.source) + ". Use Type = fine mesh.");
      mistakes.require(scene.reference.type != Reference::Type::fine_mesh
                         || scene.reference.route != Reference::MeshRoute::bricks
                         || scene.mesh.source == MeshSource::box
                         || scene.mesh.source == MeshSource::bricks,
                       "Reference/Mesh",
                       "bricks fill a box only, but the scene's mesh is a "
                         + word(scene.mesh.source) + ". Use Mesh = refine or file.");
      mistakes.throw_together();
    }

    /** @throws InputError if the scene lacks what @p which needs; @p path names
     * the parameter that asks for it. */
    void
    check_estimator(const Scene &scene, const ErrorEstimator which, const std::string &path)
    {
      Mistakes   mistakes;
      const bool has_u   = scene.exact_solution.has_displacement();
      const bool has_ref = scene.reference.type != ReferenceParameters::Type::none;
      mistakes.require(
        which != ErrorEstimator::energy || has_ref,
        path,
        "energy compares with a reference, and there is none. Set Reference/Type = fine "
        "mesh, or use spr or another estimator that needs none.");
      mistakes.require(
        which != ErrorEstimator::ren || has_ref || has_u,
        path,
        "ren compares with a reference or an exact displacement, and there is neither. Set "
        "Reference/Type = fine mesh or give Exact solution/Displacement.");
      mistakes.require(
        which != ErrorEstimator::exact || has_u,
        path,
        "exact needs the exact displacement. Give Exact solution/Displacement, or use spr or "
        "another "
        "estimator that does not need it.");
      mistakes.require(which != ErrorEstimator::richardson
                         || (scene.loads.empty() && !loads_supports(scene))
                         || !moves_supports(scene),
                       path,
                       "richardson extrapolates the energy, which gives the error only if either "
                       "loads or prescribed displacements deform the body; this scene has both. "
                       "Use spr or another estimator.");
      mistakes.require(which != ErrorEstimator::goal || !scene.goals.empty(),
                       path,
                       "the estimator 'goal' needs a goal. Add a subsection to Goals.");
      mistakes.throw_together();
    }

    /** Whether the error of Estimation/Goal is known or estimated. */
    bool
    main_goal_has_error(const Scene &scene)
    {
      const auto &listed = scene.estimation.estimators;
      if (std::find(listed.begin(), listed.end(), ErrorEstimator::goal) != listed.end()
          || (scene.adaptivity.strategy == AdaptivityParameters::Strategy::adaptive
              && scene.adaptivity.refinement_indicator == ErrorEstimator::goal))
        return true;
      for (const auto &goal : scene.goals)
        if (scene.estimation.goal.empty() || goal.name == scene.estimation.goal)
          return goal.exact && *goal.exact != 0.;
      return false;
    }

    void
    check_estimation(const Scene &scene)
    {
      Mistakes mistakes;
      for (const ErrorEstimator which : scene.estimation.estimators)
        mistakes.attempt([&]() { check_estimator(scene, which, "Estimation/Estimators"); });
      bool        known = scene.estimation.goal.empty();
      std::string names;
      for (const auto &goal : scene.goals)
        {
          known = known || goal.name == scene.estimation.goal;
          names += (names.empty() ? "" : ", ") + goal.name;
        }
      mistakes.require(known,
                       "Estimation/Goal",
                       "there is no goal '" + scene.estimation.goal + "'. "
                         + (names.empty() ? "The scene has none." : "There is: " + names + "."));
      mistakes.throw_together();
    }

    void
    check_study(const Scene &scene)
    {
      double n_runs = 1.;
      for (const auto &variation : scene.variations)
        n_runs *= variation.cases.size();
      require(n_runs <= 1000.,
              "Study",
              "its combinations are " + text_of(n_runs) + " runs. At most 1000 are made.");
    }

    void
    check_strategy(const Scene &scene)
    {
      Mistakes mistakes;
      using Adaptivity    = AdaptivityParameters;
      const auto &adapt   = scene.adaptivity;
      const bool  has_u   = scene.exact_solution.has_displacement();
      const bool  has_ref = scene.reference.type != ReferenceParameters::Type::none;
      if (adapt.strategy == Adaptivity::Strategy::mesh_list)
        mistakes.require(
          scene.mesh.n_meshes() > 1,
          "Adaptivity/Strategy",
          "a mesh list needs several meshes: give several Cells, Files or volume bounds "
          "in Mesh, or use Strategy = none.");
      else
        mistakes.require(
          scene.mesh.n_meshes() == 1,
          "Adaptivity/Strategy",
          "Mesh lists " + std::to_string(scene.mesh.n_meshes())
            + " meshes, which only Strategy = mesh list uses. Set that, or list one mesh.");
      if (adapt.strategy == Adaptivity::Strategy::adaptive)
        {
          mistakes.attempt([&]() {
            check_estimator(scene, adapt.refinement_indicator, "Adaptivity/Refinement indicator");
          });
          mistakes.require(!adapt.coarsening || scene.mesh.source != MeshSource::bricks,
                           "Adaptivity/Coarsening",
                           "bricks have no surface to mesh from scratch. Use Mesh/Type = box.");
        }
      if (scene.formulation == Formulation::finite_strain)
        {
          mistakes.throw_together(); // check_finite_strain() tells of tolerances
          return;
        }
      mistakes.require(
        adapt.tolerance == 0. || has_ref || has_u || scene.exact_solution.has_energy()
          || !energy_estimator(scene).empty(),
        "Adaptivity/Tolerance",
        "the error cannot be measured: there is no estimator of the energy norm, no reference "
        "and no exact solution. Set Estimation/Estimators = spr, or Reference/Type = fine mesh, "
        "give "
        "Exact solution/Strain energy or Exact solution/Displacement, or remove this.");
      mistakes.require(adapt.goal_tolerance == 0. || !scene.goals.empty(),
                       "Adaptivity/Goal tolerance",
                       "the scene has no goal. Add a subsection to Goals, or remove this.");
      mistakes.require(
        adapt.goal_tolerance == 0. || main_goal_has_error(scene),
        "Adaptivity/Goal tolerance",
        "the goal's error cannot be measured. Give its Exact value, or let the estimator "
        "'goal' run: in Estimation/Estimators or as Adaptivity/Refinement indicator.");
      mistakes.require(
        adapt.ren_tolerance == 0. || has_ref || has_u,
        "Adaptivity/REN tolerance",
        "REN cannot be measured: there is no reference and no exact displacement. Set "
        "Reference/Type = fine mesh, or remove this.");
      mistakes.throw_together();
    }
  } // namespace

  namespace
  {
    /** Checks each part of @p scene by itself. */
    void
    check_parts(const Scene &scene, Mistakes &mistakes)
    {
      const auto check = [&](const std::string &name, const auto &part) {
        if (mistakes.readable(name))
          mistakes.attempt([&]() { part.check(); });
      };
      const auto check_blocks = [&](const std::string &section, const auto &blocks) {
        for (const auto &block : blocks)
          check(section + "/" + block.name, block);
      };
      mistakes.require(scene.degree == 1 || scene.degree == 2,
                       "Degree",
                       "must be 1 (linear) or 2 (quadratic tetrahedra), not "
                         + std::to_string(scene.degree) + ".");
      check("Mesh", scene.mesh);
      check("TetGen", scene.tetgen);
      check_blocks("Materials", scene.materials);
      check_blocks("Supports", scene.supports);
      check("Exact solution", scene.exact_solution);
      check_blocks("Loads", scene.loads);
      check("Solver", scene.solver);
      check("Reference", scene.reference);
      check_blocks("Goals", scene.goals);
      check("Estimation", scene.estimation);
      check("Adaptivity", scene.adaptivity);
      check_blocks("Study", scene.variations);
      check("Output", scene.output);
    }
  } // namespace

  void
  check_scene(const Scene &scene, Mistakes &mistakes)
  {
    check_parts(scene, mistakes);
    Mistakes   known = mistakes.marks();
    const auto fit
      = [&](const std::initializer_list<std::string> parts, void (*check)(const Scene &)) {
          // What does not fit to something that is wrong itself need not be said.
          if (known.sound(parts))
            mistakes.attempt([&]() { check(scene); });
        };
    fit({"Materials"}, check_materials);
    fit({"Supports"}, check_supports);
    known = mistakes.marks();
    fit({"Materials"}, check_stiffness);
    fit({"Degree", "Formulation", "Materials", "Reference", "Goals", "Estimation", "Adaptivity"},
        check_formulation);
    fit({"Loads", "Supports", "Materials"}, check_loads);
    fit({"Reference", "Mesh"}, check_reference);
    fit({"Supports", "Formulation", "Reference", "Solver", "Estimation", "Adaptivity"},
        check_support_types);
    fit({"Supports", "Loads", "Reference", "Exact solution", "Estimation", "Adaptivity"},
        check_point_conditions);
    fit({"Supports", "Formulation", "Reference", "Exact solution"}, check_spring_supports);
    fit({"Estimation", "Goals", "Reference", "Exact solution", "Supports", "Loads"},
        check_estimation);
    fit({"Adaptivity",
         "Mesh",
         "Estimation",
         "Goals",
         "Reference",
         "Exact solution",
         "Supports",
         "Loads"},
        check_strategy);
    fit({"Study"}, check_study);
    fit({"Exact solution", "Mesh"}, check_exact_gradient);
  }

  void
  Scene::check() const
  {
    Mistakes mistakes;
    check_scene(*this, mistakes);
    mistakes.throw_if_any(file);
  }

  std::string
  Scene::with_place(const std::string &message) const
  {
    std::size_t longest = 0;
    std::string place;
    for (const auto &[name, where] : places)
      if (name.size() > longest && message.compare(0, name.size(), name) == 0)
        {
          // A word that happens to be a section's name is none: "Mesh files are ...".
          const char *ends = name.find('/') == std::string::npos ? ":,/" : ":,/ ";
          if (message.find_first_of(ends, name.size()) == name.size())
            {
              longest = name.size();
              place   = where;
            }
        }
    return longest > 0 ? place + ": " + message : message;
  }
} // namespace tetradapt::scene
