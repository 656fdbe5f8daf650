// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_gradation_h
#define tetradapt_adapt_gradation_h

#include "tetradapt/mesh/edges.h"

#include <vector>

namespace tetradapt::adapt
{
  /**
   * Limits how fast a field of element sizes grows along the edges of a mesh:
   * limit() makes it the largest field h <= h_0 with h(x) <= h(y) + g |x-y| for
   * every edge xy (Borouchaki, Hecht, Frey, IJNME 43, 1998). As |x-y| is a path
   * length, that is a shortest-path problem with starting costs h_0: Dijkstra,
   * O(n log n), exact. The neighbour table is built once and serves many calls.
   */
  class Gradation
  {
  public:
    /** @param mesh, edges are used during construction only.
     *  @param g growth of the size per distance; <= 0: no limit. */
    Gradation(const mesh::TetMesh &mesh, const mesh::EdgeTable &edges, double g);

    /** Lowers @p sizes (one a point, positive, infinity allowed) in place.
     * @return the number of points whose size was lowered. */
    unsigned int
    limit(std::vector<double> &sizes) const;

  private:
    struct Neighbour
    {
      unsigned int point;
      double       growth; ///< g times the length of the edge
    };
    std::vector<unsigned int> first; ///< per point its range in neighbours
    std::vector<Neighbour>    neighbours;
  };
} // namespace tetradapt::adapt

#endif
