// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/held_loads.h"

#include "tetradapt/core/surface_expression.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::mechanics
{
  namespace
  {
    /** Components x, y, z as bits 1, 2, 4. */
    using Components = unsigned int;

    /** Components of a normal below are rounding. */
    constexpr double smallest_component = 1e-9;

    /** Those of a traction that are not the constant zero. */
    Components
    components_of(const scene::LoadParameters &load)
    {
      // Where a total force has a moment about the faces' centroid, it has all of them.
      if (load.total.about || load.total.moment != scene::TotalForceParameters().moment)
        return 7;
      Components components = 0;
      for (unsigned int c = 0; c < 3; ++c)
        {
          const core::SurfaceExpression value({{load.value[c], "0", "0"}},
                                              "Loads/" + load.name + "/Value");
          if (!value.is_constant() || value(core::Point<3>(), core::Tensor<1, 3>())[0] != 0.)
            components |= 1u << c;
        }
      return components;
    }

    Components
    components_of(const dealii::Tensor<1, 3> &normal)
    {
      Components components = 0;
      for (unsigned int c = 0; c < 3; ++c)
        if (std::abs(normal[c]) > smallest_component * normal.norm())
          components |= 1u << c;
      return components;
    }

    /** What supports prescribe on a patch. */
    struct Hold
    {
      Components                                      components = 0;
      std::vector<std::string>                        sliding; ///< supports along the normal
      std::vector<std::pair<std::string, Components>> supports;
    };

    /** Whether @p support, which does not slide, prescribes a component wherever it is. Loads on
     * faces that are coupled to a reference point move that, unless it is prescribed. */
    bool
    prescribes(const scene::SupportParameters &support, const unsigned int c)
    {
      if (support.type == scene::SupportType::fixed)
        return support.components[c];
      const auto  is_set = [](const auto &component) { return component.has_value(); };
      const auto &t = support.rigid.translation, &R = support.rigid.rotation;
      return std::all_of(t.begin(), t.end(), is_set) && std::all_of(R.begin(), R.end(), is_set);
    }

    std::vector<Hold>
    holds_of(const scene::Scene &scene, const mesh::TetMesh &mesh)
    {
      std::vector<Hold> holds(mesh.patches.size());
      for (const auto &support : scene.supports)
        {
          Components components = 0;
          for (unsigned int c = 0; c < 3; ++c)
            components |= (prescribes(support, c) ? 1u : 0u) << c;
          const std::string name = "Supports/" + support.name;
          for (unsigned int p = 0; p < mesh.patches.size(); ++p)
            {
              const auto &selections = mesh.patches[p].selections;
              if (std::count(selections.begin(), selections.end(), name) == 0)
                continue;
              if (support.type == scene::SupportType::sliding)
                {
                  holds[p].sliding.push_back(name);
                  continue;
                }
              holds[p].components |= components;
              holds[p].supports.emplace_back(name, components);
            }
        }
      return holds;
    }

    /** A force on a bearing; it presses on faces whose normals point against it. */
    dealii::Tensor<1, 3>
    bearing_force(const scene::LoadParameters &load)
    {
      return core::SurfaceExpression(load.value,
                                     "Loads/" + load.name + "/Value")(core::Point<3>(),
                                                                      core::Tensor<1, 3>());
    }

    HeldLoad
    look_at(const scene::LoadParameters &load,
            const mesh::TetMesh         &mesh,
            const std::vector<Hold>     &holds)
    {
      HeldLoad result;
      result.name           = "Loads/" + load.name;
      const bool is_bearing = load.type == scene::LoadType::total_force
                              && load.total.distribution == scene::Distribution::bearing;
      const bool       is_pressure = load.type == scene::LoadType::pressure || is_bearing;
      const auto       force       = is_bearing ? bearing_force(load) : dealii::Tensor<1, 3>();
      const Components fixed       = is_pressure ? 0 : components_of(load);
      for (const auto &face : mesh.faces)
        {
          const auto &selections = mesh.patches[face.patch].selections;
          if (std::count(selections.begin(), selections.end(), result.name) == 0)
            continue;
          const auto normal = mesh::face_area_vector(mesh, face);
          if (is_bearing && normal * force >= 0.)
            continue;
          const double     area = normal.norm();
          const Components own  = is_pressure ? components_of(normal) : fixed;
          const Hold      &hold = holds[face.patch];
          result.area += area;
          const Components across = hold.sliding.empty() ? 0 : components_of(normal);
          if (across != 0 && (across & (across - 1)) != 0)
            {
              // Across an inclined face.
              if ((own & across) == 0)
                continue;
              const bool is_held = is_pressure || (own & ~hold.components) == 0;
              (is_held ? result.held_area : result.partly_area) += area;
              result.supports.insert(hold.sliding.begin(), hold.sliding.end());
              continue;
            }
          if ((own & (hold.components | across)) == 0)
            continue;
          if ((own & across) != 0)
            result.supports.insert(hold.sliding.begin(), hold.sliding.end());
          ((own & ~(hold.components | across)) == 0 ? result.held_area : result.partly_area)
            += area;
          for (const auto &[name, components] : hold.supports)
            if ((own & components) != 0)
              result.supports.insert(name);
        }
      return result;
    }

    /** "12 %", and no "100 %" for what is less. */
    std::string
    percent(const double part)
    {
      std::ostringstream text;
      text.precision(3);
      text << (part < 1. ? std::min(100. * part, 99.9) : 100.) << " %";
      return text.str();
    }
  } // namespace

  std::vector<HeldLoad>
  held_loads(const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    const std::vector<Hold> holds = holds_of(scene, mesh);
    std::vector<HeldLoad>   result;
    for (const auto &load : scene.loads)
      {
        HeldLoad held = look_at(load, mesh, holds);
        if (held.held_area > 0. || held.partly_area > 0.)
          result.push_back(std::move(held));
      }
    return result;
  }

  std::vector<std::string>
  held_load_warnings(const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    std::vector<std::string> warnings;
    for (const HeldLoad &load : held_loads(scene, mesh))
      {
        std::string supports;
        for (const std::string &name : load.supports)
          supports += (supports.empty() ? "" : " and ") + name;
        const std::string end = " by " + supports + ", which "
                                + (load.supports.size() == 1 ? "takes" : "take")
                                + " it up: it deforms nothing there. Choose other faces for one of "
                                  "them, or free these components.";
        if (load.held_area > 0.)
          warnings.push_back(load.name + ": all components of this load are held on "
                             + percent(load.held_area / load.area) + " of its area" + end);
        if (load.partly_area > 0.)
          warnings.push_back(load.name + ": some components of this load are held on "
                             + percent(load.partly_area / load.area) + " of its area" + end);
      }
    return warnings;
  }
} // namespace tetradapt::mechanics
