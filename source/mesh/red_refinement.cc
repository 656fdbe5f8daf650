// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/red_refinement.h"

#include "tetradapt/core/exceptions.h"

#include <limits>

namespace tetradapt::mesh
{
  namespace
  {
    /** A diagonal of the inner octahedron by the edges whose middles it joins,
     * and the other four middles in the order in which they surround it,
     * right-handed about the direction from the first to the second end. */
    struct Diagonal
    {
      std::array<unsigned int, 2> ends;
      std::array<unsigned int, 4> ring;
    };

    constexpr std::array<Diagonal, 3> diagonals{
      {{{{0, 5}}, {{1, 2, 3, 4}}}, {{{1, 3}}, {{0, 4, 5, 2}}}, {{{2, 4}}, {{0, 1, 5, 3}}}}};



    /** The diagonal to cut along: a later one only if it is clearly shorter, so
     * that rounding does not choose. */
    const Diagonal &
    shortest_diagonal(const TetMesh &fine, const std::array<unsigned int, 6> &middles)
    {
      unsigned int best   = 0;
      double       length = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        {
          const auto  &ends = diagonals[d].ends;
          const double candidate
            = fine.points[middles[ends[0]]].distance_square(fine.points[middles[ends[1]]]);
          if (d == 0 || candidate < (1. - 1e-10) * length)
            {
              best   = d;
              length = candidate;
            }
        }
      return diagonals[best];
    }



    /** Appends the eight parts of a cell. */
    void
    cut_cell(const std::array<unsigned int, 4> &v,
             const std::array<unsigned int, 6> &m,
             TetMesh                           &fine)
    {
      fine.cells.push_back({{v[0], m[0], m[2], m[3]}});
      fine.cells.push_back({{m[0], v[1], m[1], m[4]}});
      fine.cells.push_back({{m[2], m[1], v[2], m[5]}});
      fine.cells.push_back({{m[3], m[4], m[5], v[3]}});
      const Diagonal &diagonal = shortest_diagonal(fine, m);
      for (unsigned int i = 0; i < 4; ++i)
        fine.cells.push_back({{m[diagonal.ends[0]],
                               m[diagonal.ring[i]],
                               m[diagonal.ring[(i + 1) % 4]],
                               m[diagonal.ends[1]]}});
    }
  } // namespace



  TetMesh
  red_refine(const TetMesh &mesh, const EdgeTable *edges)
  {
    if (mesh.cells.size() > std::numeric_limits<unsigned int>::max() / 64)
      throw core::InputError("Refining a mesh of " + std::to_string(mesh.cells.size())
                             + " tetrahedra uniformly gives more than can be numbered.");
    EdgeTable own_edges;
    if (edges == nullptr)
      {
        own_edges = build_edges(mesh);
        edges     = &own_edges;
      }

    TetMesh fine;
    fine.patches      = mesh.patches;
    fine.region_names = mesh.region_names;
    fine.kept         = mesh.kept;
    fine.points.reserve(mesh.points.size() + edges->edges.size());
    fine.points = mesh.points;
    for (const auto &[a, b] : edges->edges)
      fine.points.emplace_back(0.5 * (mesh.points[a][0] + mesh.points[b][0]),
                               0.5 * (mesh.points[a][1] + mesh.points[b][1]),
                               0.5 * (mesh.points[a][2] + mesh.points[b][2]));

    fine.cells.reserve(8 * mesh.cells.size());
    fine.regions.reserve(8 * mesh.cells.size());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        std::array<unsigned int, 6> middles;
        for (unsigned int e = 0; e < 6; ++e)
          middles[e] = mesh.n_points() + edges->cell_edges[c][e];
        cut_cell(mesh.cells[c], middles, fine);
        fine.regions.insert(fine.regions.end(), 8, mesh.regions[c]);
      }

    const EdgeFinder finder(*edges, mesh.n_points());
    fine.faces.reserve(4 * mesh.faces.size());
    for (const BoundaryFace &face : mesh.faces)
      {
        const auto                 &v = face.vertices;
        std::array<unsigned int, 3> m; // m[i]: middle opposite v[i]
        for (unsigned int i = 0; i < 3; ++i)
          m[i] = mesh.n_points() + finder.find(v[(i + 1) % 3], v[(i + 2) % 3]);
        fine.faces.push_back({{{v[0], m[2], m[1]}}, face.patch});
        fine.faces.push_back({{{m[2], v[1], m[0]}}, face.patch});
        fine.faces.push_back({{{m[1], m[0], v[2]}}, face.patch});
        fine.faces.push_back({{{m[0], m[1], m[2]}}, face.patch});
      }
    return fine;
  }
} // namespace tetradapt::mesh
