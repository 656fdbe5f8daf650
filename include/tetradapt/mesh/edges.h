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

  /**
   * Numbers the edges of @p mesh. Linear in the number of cells (edges are put
   * into one bucket a point), so that one point with a great many edges does no
   * harm.
   */
  EdgeTable
  build_edges(const TetMesh &mesh);

  /** Finds the number of an edge from its two end points. */
  class EdgeFinder
  {
  public:
    /** @p table must outlive the finder. @p n_points is that of the mesh. */
    EdgeFinder(const EdgeTable &table, unsigned int n_points);

    /** Number of the edge between points @p a and @p b, in any order, or
     * numbers::invalid_unsigned_int if there is none. */
    unsigned int
    find(unsigned int a, unsigned int b) const;

  private:
    std::vector<unsigned int>                begin;   ///< per point: first entry below
    std::vector<std::array<unsigned int, 2>> entries; ///< larger end, edge number; sorted
  };
} // namespace tetradapt::mesh

#endif
