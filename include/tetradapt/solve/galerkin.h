// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_galerkin_h
#define tetradapt_solve_galerkin_h

#include "tetradapt/solve/aggregation.h"

namespace tetradapt::solve
{
  /** Aggregates and their tentative prolongation as seen by the nodes of a matrix's
   * layout: first the owned ones, then ghosts. */
  template <unsigned int n>
  struct LocalTentative
  {
    std::vector<unsigned int> aggregates; ///< number over all ranks, or no_aggregate
    std::vector<NodeModes<n>> rows;
  };

  /** P = (1 - omega D^-1 A) T on the rows of @p matrix. Columns are aggregates, of which
   * there are @p n_aggregates over all ranks. */
  template <unsigned int n>
  BlockRows<n, 6>
  smooth(const BlockRows<n, n>                        &matrix,
         const std::vector<std::array<double, n * n>> &inverse_diagonal,
         const LocalTentative<n>                      &tentative,
         unsigned int                                  n_aggregates,
         double                                        omega);

  /** (1 - omega D^-1 A) P on the rows of @p matrix; @p prolongation has those of ghosts
   * also. */
  template <unsigned int n>
  BlockRows<n, 6>
  smooth_further(const BlockRows<n, n>                        &matrix,
                 const std::vector<std::array<double, n * n>> &inverse_diagonal,
                 const BlockRows<n, 6>                        &prolongation,
                 unsigned int                                  n_aggregates,
                 double                                        omega);

  /** P^T A P for the rows of @p matrix only; @p prolongation has those of ghosts also.
   * All @p n_aggregates rows. */
  template <unsigned int n>
  BlockRows<6, 6>
  galerkin(const BlockRows<n, n> &matrix,
           const BlockRows<n, 6> &prolongation,
           unsigned int           n_aggregates);
} // namespace tetradapt::solve

#endif
