// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_cluster_jacobi_h
#define tetradapt_solve_cluster_jacobi_h

#include "tetradapt/solve/aggregation.h"

#include <deal.II/base/aligned_vector.h>

namespace tetradapt::solve
{
  /**
   * The inverses of diagonal blocks that several nodes of three unknowns share: in flat cells
   * the nodes above each other are coupled so strongly that blocks of single nodes smooth
   * nothing along the other directions.
   */
  template <typename Number>
  class ClusterJacobi
  {
  public:
    /** @param rows are those of the owned nodes, times @p scale.
     * @param clusters are sets of owned nodes. Those of one node are left to BlockJacobi. */
    ClusterJacobi(const BlockRows<3, 3> &rows, const Aggregates &clusters, double scale);

    /** The blocks of BlockJacobi with zeros for the nodes of clusters. */
    template <typename Block>
    std::vector<Block>
    without_own(std::vector<Block> inverses) const
    {
      for (const unsigned int node : nodes)
        inverses[node].fill(0);
      return inverses;
    }

    /** z = factor D^-1 r with the clusters' blocks; d += z and x += z. */
    void
    add(double factor, const Number *r, Number *d, Number *x) const;

  private:
    void
    append_inverse(const BlockRows<3, 3> &rows, std::size_t first, double scale);

    std::vector<std::size_t>      begin{0}; ///< of each cluster in nodes, and the end
    std::vector<unsigned int>     nodes;
    dealii::AlignedVector<Number> inverses;    ///< whole symmetric matrices, one after the other
    unsigned int                  largest = 0; ///< unknowns of a cluster
  };
} // namespace tetradapt::solve

#endif
