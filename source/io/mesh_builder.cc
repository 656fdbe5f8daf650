// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/mesh_builder.h"

#include "tetradapt/mesh/finalize.h"

#include <set>

namespace tetradapt::io
{
  template <std::size_t n>
  void
  MeshBuilder::check(const std::array<unsigned int, n> &nodes) const
  {
    for (const unsigned int node : nodes)
      if (node >= mesh.points.size())
        fail("an element names point " + std::to_string(node) + " (counted from 0), but there are "
             + std::to_string(mesh.points.size()) + " points.");
  }



  void
  MeshBuilder::add_cell(const std::array<unsigned int, 4> &vertices, const int region)
  {
    check(vertices);
    mesh.cells.push_back(vertices);
    mesh.regions.push_back(region);
  }



  void
  MeshBuilder::add_quadratic_cell(const std::array<unsigned int, 10> &nodes, const int region)
  {
    check(nodes);
    for (unsigned int e = 0; e < 6; ++e)
      {
        const Point<3> &a             = mesh.points[nodes[mesh::edge_vertices[e][0]]];
        const Point<3> &b             = mesh.points[nodes[mesh::edge_vertices[e][1]]];
        const Point<3> &m             = mesh.points[nodes[4 + e]];
        const double    length_square = a.distance_square(b);
        double          offset_square = 0.;
        for (unsigned int d = 0; d < 3; ++d)
          offset_square += (m[d] - 0.5 * (a[d] + b[d])) * (m[d] - 0.5 * (a[d] + b[d]));
        if (!(offset_square <= 1e-12 * length_square))
          fail("a second-order tetrahedron has a curved edge: its node at " + mesh::to_string(m)
               + " is not in the middle between " + mesh::to_string(a) + " and "
               + mesh::to_string(b)
               + ". Only straight tetrahedra can be used: save the mesh in first order.");
      }
    mesh.cells.push_back({{nodes[0], nodes[1], nodes[2], nodes[3]}});
    mesh.regions.push_back(region);
  }



  void
  MeshBuilder::add_face(const std::array<unsigned int, 3> &vertices, const int boundary_id)
  {
    check(vertices);
    const auto [entry, is_new] = patch_of_id.emplace(boundary_id, mesh.patches.size());
    if (is_new)
      {
        mesh::Patch patch;
        patch.boundary_id = boundary_id;
        mesh.patches.push_back(patch);
      }
    mesh.faces.push_back({vertices, entry->second});
  }



  mesh::TetMesh
  MeshBuilder::take()
  {
    for (mesh::Patch &patch : mesh.patches)
      if (const auto name = boundary_names.find(patch.boundary_id); name != boundary_names.end())
        patch.name = name->second;
    const std::set<int> used(mesh.regions.begin(), mesh.regions.end());
    for (auto name = mesh.region_names.begin(); name != mesh.region_names.end();)
      name = used.count(name->first) == 0 ? mesh.region_names.erase(name) : std::next(name);

    mesh::TetMesh result;
    std::swap(result, mesh);
    patch_of_id.clear();
    boundary_names.clear();
    return result;
  }
} // namespace tetradapt::io
