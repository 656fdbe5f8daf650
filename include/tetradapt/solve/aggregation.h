// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_aggregation_h
#define tetradapt_solve_aggregation_h

#include "tetradapt/solve/block_rows.h"

namespace tetradapt::solve
{
  /** Values of the six rigid motions at a node with n unknowns, row by row: entry
   * 6 i + k is motion k in unknown i; zero where it is prescribed. */
  template <unsigned int n>
  using NodeModes = std::array<double, 6 * n>;

  constexpr unsigned int no_aggregate = -1;

  /** Disjoint sets of nodes. */
  struct Aggregates
  {
    std::vector<unsigned int> of_node; ///< no_aggregate where nothing is to be corrected
    unsigned int              count = 0;
  };

  /**
   * Puts the nodes of this rank into sets of strongly coupled neighbours (Vanek, Mandel
   * and Brezina, Computing 56, 1996): nodes i and j are if |A_ij|, in Frobenius' norm, is
   * above the threshold times the lesser of the largest couplings of i and of j. So every
   * node has a neighbour, but those without any coupling, as supports make, which get no
   * aggregate.
   */
  template <unsigned int n>
  Aggregates
  aggregate(const BlockRows<n, n> &matrix, double threshold);

  /** What rigid motions look like from aggregates. */
  template <unsigned int n>
  struct TentativeProlongation
  {
    std::vector<NodeModes<n>> rows;         ///< of each node: n x 6, orthonormal columns
    std::vector<NodeModes<6>> coarse_modes; ///< the motions in the aggregates' unknowns
  };

  /** Orthonormalises the motions in each aggregate. A motion that depends on others
   * there, as in an aggregate of one node, gets a column of zeros. */
  template <unsigned int n>
  TentativeProlongation<n>
  tentative_prolongation(const Aggregates &aggregates, const std::vector<NodeModes<n>> &modes);
} // namespace tetradapt::solve

#endif
