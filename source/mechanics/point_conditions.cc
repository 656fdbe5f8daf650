// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/point_conditions.h"

#include "tetradapt/core/expression.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/mesh/kept_places.h"

#include <algorithm>
#include <stdexcept>

namespace tetradapt::mechanics
{
  namespace
  {
    const mesh::KeptPlace &
    place_of(const mesh::TetMesh &mesh, const std::string &name)
    {
      const mesh::KeptPlace *place = mesh::find_place(mesh, name);
      if (place == nullptr)
        throw std::logic_error("The mesh has no vertices for " + name + ".");
      return *place;
    }

    dealii::Tensor<1, 3>
    force_of(const scene::LoadParameters &load, const dealii::Point<3> &point)
    {
      return core::VectorExpression(load.value, "Loads/" + load.name + "/Value")(point);
    }
  } // namespace

  std::pair<unsigned int, dealii::Tensor<1, 3>>
  point_force(const scene::LoadParameters &load, const mesh::TetMesh &mesh)
  {
    const unsigned int vertex
      = mesh::vertices_of(mesh, place_of(mesh, "Loads/" + load.name)).front();
    return {vertex, force_of(load, mesh.points[vertex])};
  }

  std::vector<unsigned int>
  held_place_nodes(const scene::SupportParameters &support,
                   const mesh::TetMesh            &mesh,
                   const mesh::EdgeTable          *edges)
  {
    auto nodes = mesh::vertices_of(mesh, place_of(mesh, "Supports/" + support.name));
    if (edges != nullptr && nodes.size() > 1)
      {
        const mesh::EdgeFinder finder(*edges, mesh.n_points());
        const std::size_t      n_vertices = nodes.size();
        for (std::size_t i = 1; i < n_vertices; ++i)
          nodes.push_back(mesh.n_points() + finder.find(nodes[i - 1], nodes[i]));
      }
    return nodes;
  }

  std::vector<std::string>
  held_point_force_warnings(const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    std::vector<std::string> warnings;
    if (std::none_of(scene.loads.begin(), scene.loads.end(), [](const auto &load) {
          return load.type == scene::LoadType::point_force;
        }))
      return warnings;
    const PrescribedDisplacement prescribed = prescribe(scene.supports, mesh, nullptr, scene.mesh);
    for (const auto &load : scene.loads)
      {
        if (load.type != scene::LoadType::point_force)
          continue;
        const std::string name     = "Loads/" + load.name;
        const auto [vertex, force] = point_force(load, mesh);
        unsigned int n_held = 0, n = 0;
        for (unsigned int c = 0; c < 3; ++c)
          if (force[c] != 0.)
            {
              ++n;
              n_held += prescribed.is_fixed(vertex, c) ? 1 : 0;
            }
        if (prescribed.fixed[vertex] == PrescribedDisplacement::is_inclined)
          {
            const auto   free   = prescribed.free_part(vertex, force);
            const double little = 1e-9 * force.norm();
            n                   = 2; // a single component may be held in part
            n_held              = free.norm() < little ? 2 : (force - free).norm() > little ? 1 : 0;
          }
        if (n_held > 0)
          warnings.push_back(name + ": " + (n_held == n ? "all" : "some")
                             + " components of this force act on the " + "vertex "
                             + mesh::to_string(mesh.points[vertex])
                             + ", where supports hold them: these components deform nothing. Move "
                               "the point, or free these "
                               "components.");
      }
    return warnings;
  }
} // namespace tetradapt::mechanics
