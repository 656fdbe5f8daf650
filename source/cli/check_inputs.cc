// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/check_inputs.h"

#include "tetradapt/adapt/placement.h"
#include "tetradapt/adapt/saved_sizes.h"
#include "tetradapt/core/condition.h"
#include "tetradapt/io/mesh_source.h"
#include "tetradapt/io/outline.h"
#include "tetradapt/io/volume_reader.h"
#include "tetradapt/io/vtu_reader.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/boundary_projection.h"
#include "tetradapt/mesh/face_selectors.h"
#include "tetradapt/mesh/selection.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::cli
{
  namespace
  {
    /** Whether the scene says all of its meshes, so that none has to be generated. */
    bool
    has_given_meshes(const scene::MeshParameters &mesh)
    {
      const bool refined = !mesh.size.empty()
                           || std::any_of(mesh.volume_bounds.begin(),
                                          mesh.volume_bounds.end(),
                                          [](double bound) { return bound > 0.; });
      return mesh.source == scene::MeshSource::bricks
             || (mesh.source == scene::MeshSource::file && !refined);
    }

    /** Checks the names of groups, ids and regions. */
    void
    check_all_names(const scene::Scene  &scene,
                    const mesh::TetMesh &outline,
                    scene::Mistakes     &mistakes)
    {
      const auto selectors = mesh::face_selectors(scene);
      for (const auto &[name, selector] : selectors)
        mistakes.attempt([&, &name = name, &selector = selector]() {
          mesh::check_names(outline, name, selector);
        });
      mistakes.attempt([&]() { const mechanics::MaterialMap materials(scene, outline); });
      for (const auto &load : scene.loads)
        {
          const std::string name = "Loads/" + load.name;
          if (std::none_of(selectors.begin(), selectors.end(), [&](const auto &entry) {
                return entry.first == name;
              }))
            mistakes.attempt([&]() {
              mechanics::resolve_regions(load.selector.ids, load.selector.groups, outline, name);
            });
        }
    }

    /** Asks each condition at points all over the surface. */
    void
    check_conditions(const scene::Scene  &scene,
                     const mesh::TetMesh &outline,
                     scene::Mistakes     &mistakes,
                     const core::Log     &log)
    {
      constexpr double   wanted_points = 2000.;
      const unsigned int n_parts
        = std::max(1., std::ceil(std::sqrt(2. * wanted_points / outline.faces.size())));
      std::vector<mesh::Point<3>> points;
      for (const auto &face : outline.faces)
        {
          const auto on_face = io::points_on(outline, face, n_parts);
          points.insert(points.end(), on_face.begin(), on_face.end());
        }
      for (const auto &[name, selector] : mesh::face_selectors(scene))
        if (!selector.where.empty())
          mistakes.attempt([&, &name = name, &selector = selector]() {
            const core::Condition condition(selector.where, name + "/Where");
            const auto found = std::count_if(points.begin(), points.end(), [&](const auto &p) {
              return condition.holds(p);
            });
            if (found == 0)
              log.warning(scene.with_place(
                name + "/Where: '" + selector.where + "' holds at none of "
                + std::to_string(points.size())
                + " points all over the surface. Look with --preview whether it finds any face."));
          });
    }

    /** As io::make_mesh(), but an empty selection does not hide the others. */
    void
    check_given_mesh(const scene::Scene &scene,
                     const unsigned int  number,
                     scene::Mistakes    &mistakes,
                     const core::Log    &log)
    {
      const core::Log silent;
      if (mistakes.attempt([&]() {
            const auto body = std::make_shared<mesh::TetMesh>(io::make_mesh(scene, number, silent));
            mistakes.attempt([&]() { adapt::check_placement(scene, body, log); });
          }))
        return;
      const auto only = [&](const auto &keep) {
        scene::Scene part = scene;
        part.supports.clear();
        part.loads.clear();
        part.goals.clear();
        keep(part);
        mistakes.attempt([&]() { io::make_mesh(part, number, silent); });
      };
      for (const auto &support : scene.supports)
        only([&](scene::Scene &part) { part.supports.push_back(support); });
      for (const auto &load : scene.loads)
        only([&](scene::Scene &part) { part.loads.push_back(load); });
      for (const auto &goal : scene.goals)
        only([&](scene::Scene &part) { part.goals.push_back(goal); });
    }

    void
    check_mesh(const scene::Scene &scene,
               const unsigned int  number,
               scene::Mistakes    &mistakes,
               const core::Log    &log)
    {
      const bool    given = has_given_meshes(scene.mesh);
      mesh::TetMesh outline;
      if (!mistakes.attempt([&]() { outline = io::outline(scene.mesh, number); }))
        return;
      scene::Mistakes found;
      check_all_names(scene, outline, found);
      if (!given)
        {
          check_conditions(scene, outline, found, log);
          io::check_kept_places(scene, number, found);
        }
      if (given && found.empty())
        check_given_mesh(scene, number, found, log);
      else if (!given)
        found.attempt([&]() {
          const auto projection = mesh::make_projection(scene);
          if (projection != nullptr && scene.mesh.source == scene::MeshSource::file)
            projection->assign(outline);
        });
      mistakes.merge(found);
    }

    void
    check_reference(const scene::Scene &scene)
    {
      using Reference        = scene::ReferenceParameters;
      const auto &parameters = scene.reference;
      if (parameters.type == Reference::Type::run)
        io::read_displacement_vtu(parameters.file);
      else if (parameters.type == Reference::Type::fine_mesh
               && parameters.route == Reference::MeshRoute::file)
        {
          mesh::TetMesh mesh = io::read_volume_mesh(parameters.file);
          mesh::select_faces(mesh, mesh::face_selectors(scene));
        }
    }
  } // namespace

  void
  check_inputs(const scene::Scene &scene, scene::Mistakes &mistakes, const core::Log &log)
  {
    // A list of volume bounds is one body.
    const unsigned int n_bodies = has_given_meshes(scene.mesh)
                                    ? scene.mesh.n_meshes()
                                    : std::max<unsigned int>(1, scene.mesh.files.size());
    for (unsigned int number = 0; number < n_bodies; ++number)
      check_mesh(scene, number, mistakes, log);
    if (!scene.mesh.size_field.empty())
      mistakes.attempt([&]() { const adapt::SavedSizes sizes(scene.mesh.size_field); });
    mistakes.attempt([&]() { check_reference(scene); });
  }
} // namespace tetradapt::cli
