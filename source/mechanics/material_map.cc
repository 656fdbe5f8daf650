// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/laws/law_catalogue.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mechanics/volume_density.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace tetradapt::mechanics
{
  namespace
  {
    using scene::LoadType;

    std::string
    list_regions(const std::set<int> &regions, const std::map<int, std::string> &names)
    {
      std::ostringstream text;
      for (const int region : regions)
        {
          text << (text.tellp() > 0 ? ", " : "") << region;
          const auto name = names.find(region);
          if (name != names.end() && !name->second.empty())
            text << " ('" << name->second << "')";
        }
      return text.str();
    }

    /** What a load's value is multiplied with in a material. */
    double
    factor(const LoadType type, const scene::MaterialParameters &material)
    {
      switch (type)
        {
        case LoadType::temperature:
          return material.thermal_expansion;
        case LoadType::gravity:
        case LoadType::rotation:
          return material.density;
        default:
          return 1.;
        }
    }

    std::string
    exact_text(const double value)
    {
      std::ostringstream text;
      text.precision(17);
      text << '(' << value << ')';
      return text.str();
    }

    /** w^2 (r - (r . e) e) with r = x - p, for the angular velocity w about the axis through p in
     * the direction of the unit vector e. */
    std::array<std::string, 3>
    centrifugal_acceleration(const scene::RotationParameters &rotation)
    {
      const double               w = rotation.angular_velocity;
      const dealii::Point<3>     e = *rotation.axis / rotation.axis->norm();
      std::array<std::string, 3> texts{{"0", "0", "0"}};
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            const double slope = w * w * ((i == j ? 1. : 0.) - e[i] * e[j]);
            if (slope != 0.)
              texts[i] += " + " + exact_text(slope) + "*(" + "xyz"[j] + " - "
                          + exact_text(rotation.axis_point[j]) + ")";
          }
      return texts;
    }
  } // namespace

  std::set<int>
  resolve_regions(const std::vector<int>         &ids,
                  const std::vector<std::string> &groups,
                  const mesh::TetMesh            &mesh,
                  const std::string              &what)
  {
    const std::set<int> existing(mesh.regions.begin(), mesh.regions.end());
    if (ids.empty() && groups.empty())
      return existing;
    std::set<int> result;
    for (const int id : ids)
      {
        if (existing.count(id) == 0)
          throw core::InputError(what + " names region " + std::to_string(id)
                                 + ", which the mesh does not have. Its regions are "
                                 + list_regions(existing, mesh.region_names) + ".");
        result.insert(id);
      }
    for (const auto &group : groups)
      {
        const auto found = std::find_if(mesh.region_names.begin(),
                                        mesh.region_names.end(),
                                        [&](const auto &entry) { return entry.second == group; });
        if (found == mesh.region_names.end())
          throw core::InputError(what + " names the region group '" + group
                                 + "', which the mesh does not have. Its regions are "
                                 + list_regions(existing, mesh.region_names) + ".");
        result.insert(found->first);
      }
    return result;
  }

  namespace
  {
    /** @throws core::InputError if the law is not for @p formulation. */
    std::shared_ptr<ConstitutiveLaw>
    law_of(const scene::MaterialParameters &parameters, const scene::Formulation formulation)
    {
      std::shared_ptr<ConstitutiveLaw> law;
      try
        {
          law = laws::make_law(parameters.law, parameters.constants);
        }
      catch (const core::InputError &error)
        {
          throw core::InputError("Materials/" + parameters.name + "/Law: " + error.what());
        }
      if (!law->supports(formulation)
          || (formulation != scene::Formulation::finite_strain
              && dynamic_cast<const LinearLaw *>(law.get()) == nullptr))
        throw core::InputError("Materials/" + parameters.name + "/Law: the law '" + parameters.law
                               + "' is not for the scene's Formulation.");
      return law;
    }
  } // namespace

  MaterialMap::MaterialMap(const scene::Scene &scene, const mesh::TetMesh &mesh)
    : materials(scene.materials),
      temperatures(std::make_shared<VolumeDensity>(mesh::bounding_box(mesh))),
      mixed(scene.formulation == scene::Formulation::mixed)
  {
    // Materials that name regions come first; one that names none fills the rest.
    std::vector<const scene::MaterialParameters *> order;
    for (const auto &material : materials)
      order.push_back(&material);
    std::stable_partition(order.begin(), order.end(), [](const auto *material) {
      return !material->regions.empty() || !material->region_groups.empty();
    });
    const scene::MaterialParameters *rest = nullptr;
    for (const auto *material : order)
      {
        const bool everywhere = material->regions.empty() && material->region_groups.empty();
        if (everywhere && rest != nullptr)
          throw core::InputError("Materials/" + material->name + " and Materials/" + rest->name
                                 + " both name no region: only one material can fill what the "
                                   "others leave. Give one of them Regions or Region groups.");
        if (everywhere)
          rest = material;
        const std::shared_ptr<ConstitutiveLaw> law = law_of(*material, scene.formulation);
        for (const int region : resolve_regions(
               material->regions, material->region_groups, mesh, "Materials/" + material->name))
          {
            const auto existing = entries.find(region);
            if (existing == entries.end())
              entries[region] = Entry{material, law, dynamic_cast<const LinearLaw *>(law.get())};
            else if (!everywhere)
              throw core::InputError("Region " + std::to_string(region)
                                     + " is given two materials, Materials/"
                                     + existing->second.parameters->name + " and Materials/"
                                     + material->name + ". Name it in one of them only.");
          }
      }
    for (const int region : std::set<int>(mesh.regions.begin(), mesh.regions.end()))
      if (entries.count(region) == 0)
        throw core::InputError(
          "Region " + std::to_string(region)
          + " of the mesh has no material. Name it in one of the Materials, or "
            "add a material without Regions, which fills what the others leave.");
    add_loads(scene, mesh);
  }

  void
  MaterialMap::add_loads(const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    for (unsigned int i = 0; i < scene.loads.size(); ++i)
      {
        const scene::LoadParameters &load = scene.loads[i];
        if (load.type != LoadType::temperature && load.type != LoadType::body_force
            && load.type != LoadType::gravity && load.type != LoadType::rotation)
          continue;
        const std::string     what = "Loads/" + load.name;
        std::map<int, double> factors;
        for (const int region :
             resolve_regions(load.selector.ids, load.selector.groups, mesh, what))
          factors[region] = factor(load.type, parameters(region));
        if (load.type == LoadType::temperature)
          {
            temperatures->add_term({{load.value[0], "0", "0"}},
                                   what,
                                   factors,
                                   load.smallest_feature);
            thermal = true;
          }
        else
          {
            auto density = std::make_shared<VolumeDensity>(mesh::bounding_box(mesh));
            density->add_term(load.type == LoadType::rotation
                                ? centrifugal_acceleration(load.rotation)
                                : load.value,
                              what,
                              factors,
                              load.smallest_feature);
            forces.emplace(i, std::move(density));
          }
      }
  }

  const MaterialMap::Entry &
  MaterialMap::entry(int region) const
  {
    const auto found = entries.find(region);
    if (found == entries.end())
      throw core::InputError("Region " + std::to_string(region)
                             + " has no material: it was not in the mesh that the materials were "
                               "given for.");
    return found->second;
  }

  const ConstitutiveLaw &
  MaterialMap::law(int region) const
  {
    return *entry(region).law;
  }

  const LinearLaw &
  MaterialMap::linear_law(int region) const
  {
    const Entry &found = entry(region);
    if (found.linear == nullptr)
      throw core::InputError("Materials/" + found.parameters->name + "/Law: '"
                             + found.parameters->law
                             + "' is not linear, and something that the scene asks for is for "
                               "linear laws only.");
    return *found.linear;
  }

  bool
  MaterialMap::is_linear() const
  {
    return std::all_of(entries.begin(), entries.end(), [](const auto &entry) {
      return entry.second.linear != nullptr;
    });
  }

  const scene::MaterialParameters &
  MaterialMap::parameters(int region) const
  {
    return *entry(region).parameters;
  }

  PressureForm
  MaterialMap::pressure_form(int region) const
  {
    const auto form = linear_law(region).pressure_form();
    if (!form)
      throw core::InputError("Materials/" + parameters(region).name
                             + "/Poisson ratio: must be positive with Formulation = mixed, which "
                               "is for nearly incompressible bodies.");
    return *form;
  }

  bool
  MaterialMap::has_thermal_strain() const
  {
    return thermal;
  }

  SymmetricTensor<2, 3>
  MaterialMap::thermal_strain(int region, const dealii::Point<3> &point) const
  {
    return thermal ? temperatures->value(region, point)[0] * dealii::unit_symmetric_tensor<3>()
                   : SymmetricTensor<2, 3>();
  }
} // namespace tetradapt::mechanics
