// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_edges_h
#define tetradapt_mesh_edges_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::mesh
{
  /**
   * Local vertex numbers of a tetrahedron's edges: deal.II's line order, which
   * is also VTK's order of the mid-edge nodes of a quadratic tetrahedron.
   */
  constexpr std::array<std::array<unsigned int, 2>, 6> edge_vertices{
    {{{0, 1}}, {{1, 2}}, {{2, 0}}, {{0, 3}}, {{1, 3}}, {{2, 3}}}};

  /** The edges of a mesh, numbered in the order in which cells first name them. */
  struct EdgeTable
  {
    std::vector<std::array<unsigned int, 2>> edges;      ///< point numbers, smaller first
    std::vector<std::array<unsigned int, 6>> cell_edges; ///< per cell, in edge_vertices order
  };

  EdgeTable build_edges(const TetMesh &mesh);
} // namespace tetradapt::mesh

#endif
