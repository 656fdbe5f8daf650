// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_flat_correction_h
#define tetradapt_source_solve_flat_correction_h

#include "tetradapt/fem/fixed_unknowns.h"
#include "tetradapt/solve/flat_nodes.h"

#include "aggregate_levels.h"

#include <optional>

namespace tetradapt::solve
{
  /**
   * What p-multigrid lacks where quadratic cells are flat or long: blocks of several nodes for
   * the smoother, and a second coarse space.
   *
   * Linear cells that are a / t times longer than thick are (a / t)^2 times too stiff in
   * bending, so that a correction of degree 1 leaves all but a (t / a)^2-th part of it. Here
   * every cluster of nodes, such as those above each other in a plate, moves as a rigid body
   * instead, like the fibres of a shell; that space is solved by aggregates of few clusters
   * with smoothed prolongations.
   */
  template <typename Number>
  class FlatCorrection
  {
  public:
    /** Collective. @param matrix is that of @p space with the supports built in, all times
     * @p scale in the results. Keeps nothing of them. */
    FlatCorrection(const BlockRows<3, 3>    &matrix,
                   const fem::Space         &space,
                   const fem::FixedUnknowns &fixed,
                   const FlatNodes          &flat,
                   double                    scale);

    const ClusterJacobi<Number> &
    blocks() const
    {
      return jacobi;
    }

    /** x += correction for the residual. Collective. */
    void
    correct(const VectorOf<Number> &residual, VectorOf<Number> &x) const;

  private:
    Aggregates                     clusters;
    ClusterJacobi<Number>          jacobi;
    Prolongation<Number, 3>        prolongation;
    std::optional<AggregateLevels> levels;
  };
} // namespace tetradapt::solve

#endif
