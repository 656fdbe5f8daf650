// SPDX-License-Identifier: AGPL-3.0-or-later
#include "consistency.h"
#include "special_loads.h"
#include "values.h"

#include "tetradapt/scene/words.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tetradapt::scene
{
  namespace
  {
    using Marking   = AdaptivityParameters::Marking;
    using Strategy  = AdaptivityParameters::Strategy;
    using Route     = ReferenceParameters::MeshRoute;
    using Reference = ReferenceParameters::Type;

    /** Angles above make faces larger by 2 % and more. */
    constexpr double largest_rotation = 0.2;

    /** Parameters that another choice makes meaningless, with that choice. */
    std::vector<std::pair<std::string, std::string>>
    unused_parameters(const Scene &scene)
    {
      std::vector<std::pair<std::string, std::string>> unused;
      const auto                                       when = [&](const bool                      condition,
                            const std::vector<std::string> &paths,
                            const std::string              &reason) {
        for (const auto &path : paths)
          if (condition && scene.places.count(path) > 0)
            unused.emplace_back(path, reason);
      };
      const auto &mesh      = scene.mesh;
      const auto &reference = scene.reference;
      const auto &adapt     = scene.adaptivity;
      when(mesh.source != MeshSource::bricks, {"Mesh/Cells"}, "Mesh/Type = " + word(mesh.source));
      when(mesh.source != MeshSource::box && mesh.source != MeshSource::bricks,
           {"Mesh/Lower corner", "Mesh/Upper corner"},
           "Mesh/Type = " + word(mesh.source));
      when(mesh.source != MeshSource::blocks,
           {"Mesh/Blocks", "Mesh/Block regions"},
           "Mesh/Type = " + word(mesh.source));
      const bool slides
        = std::any_of(scene.supports.begin(), scene.supports.end(), [](const auto &support) {
            return support.type == SupportType::sliding;
          });
      when(mesh.source != MeshSource::surface && !slides,
           {"Mesh/Feature angle"},
           "Mesh/Type = " + word(mesh.source));
      const bool        fine = reference.type == Reference::fine_mesh;
      const std::string type = "Reference/Type = " + word(reference.type);
      when(!fine,
           {"Reference/Mesh", "Reference/Cells", "Reference/Volume bound", "Reference/Size"},
           type);
      when(reference.type != Reference::hexahedra,
           {"Reference/Tolerance", "Reference/Maximum unknowns"},
           type);
      when(fine && reference.route != Route::bricks,
           {"Reference/Cells"},
           "Reference/Mesh = " + word(reference.route));
      when(fine && reference.route != Route::refine,
           {"Reference/Volume bound", "Reference/Size"},
           "Reference/Mesh = " + word(reference.route));
      when(fine && reference.route != Route::file,
           {"Reference/File"},
           "Reference/Mesh = " + word(reference.route));
      const bool adaptive = adapt.strategy == Strategy::adaptive;
      when(!adaptive,
           {"Adaptivity/Refinement indicator",
            "Adaptivity/Marking",
            "Adaptivity/Size control",
            "Adaptivity/Safeguard",
            "Adaptivity/Coarsening"},
           "Adaptivity/Strategy = " + word(adapt.strategy));
      const std::string marking = "Adaptivity/Marking = " + word(adapt.marking);
      when(adaptive && adapt.marking != Marking::maximum,
           {"Adaptivity/Lambda", "Adaptivity/Minimum new fraction"},
           marking);
      when(adaptive && adapt.marking != Marking::fixed_fraction, {"Adaptivity/Fraction"}, marking);
      when(adaptive && adapt.marking != Marking::doerfler, {"Adaptivity/Theta"}, marking);
      when(adaptive && adapt.marking != Marking::optimal_size,
           {"Adaptivity/Growth",
            "Adaptivity/Minimum ratio",
            "Adaptivity/Maximum ratio",
            "Adaptivity/Maximum size",
            "Adaptivity/Gradation"},
           marking);
      when(adaptive && adapt.marking == Marking::optimal_size, {"Adaptivity/Reduction"}, marking);
      when(adapt.strategy == Strategy::none || adapt.strategy == Strategy::mesh_list,
           {"Adaptivity/Maximum cycles",
            "Adaptivity/Tolerance",
            "Adaptivity/REN tolerance",
            "Adaptivity/Goal tolerance"},
           "Adaptivity/Strategy = " + word(adapt.strategy));
      when(scene.formulation == Formulation::finite_strain,
           {"Solver/Stopping", "Solver/Solver error fraction", "Estimation/Goal"},
           "Formulation = finite strain");
      return unused;
    }
  } // namespace

  std::vector<std::string>
  Scene::warnings() const
  {
    std::vector<std::string> messages;
    for (const auto &[path, reason] : unused_parameters(*this))
      messages.push_back(path + ": has no effect with " + reason + ".");
    for (const auto &load : loads)
      {
        const std::string path = "Loads/" + load.name;
        if (const std::string zero = zero_parameter(load); !zero.empty())
          messages.push_back(path + "/" + zero + ": is zero, so that the load does nothing.");
        if (load.type == LoadType::temperature && !expands(*this, load))
          messages.push_back(path
                             + "/Type: the temperature does nothing, for no material it acts on "
                               "has a Thermal expansion.");
      }
    for (const auto &support : supports)
      if (support.type == SupportType::rigid)
        for (const auto &angle : support.rigid.rotation)
          if (std::abs(angle.value_or(0.)) > largest_rotation)
            messages.push_back(
              "Supports/" + support.name + "/Rotation: " + text_of(*angle)
              + " radians are not small: points move along tangents, and the faces "
                "grow. Angles are in radians.");
    if (const std::string message = stiffness_warning(*this); !message.empty())
      messages.push_back(message);
    if (tetgen.radius_edge_ratio < 1.1)
      messages.push_back(
        "TetGen/Radius-edge ratio: TetGen may take very long with a bound below 1.1.");
    if (adaptivity.strategy == Strategy::adaptive && tetgen.keep_boundary)
      messages.push_back("TetGen/Keep boundary: adaptive refinement stalls without new points on "
                         "the boundary.");
    if (adaptivity.strategy == Strategy::adaptive && adaptivity.max_cycles == 1)
      messages.push_back("Adaptivity/Maximum cycles: with one cycle nothing is refined.");
    if (reference.type == Reference::fine_mesh && reference.degree < degree)
      messages.push_back("Reference/Degree: " + std::to_string(reference.degree)
                         + " is lower than the scene's Degree, " + std::to_string(degree)
                         + ": the reference may be worse than what is compared with it.");
    for (const auto &message : locking_warnings(*this))
      messages.push_back(message);
    for (auto &message : messages)
      message = with_place(message);
    return messages;
  }
} // namespace tetradapt::scene
