// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_feature_grid_h
#define tetradapt_mechanics_feature_grid_h

#include "tetradapt/mechanics/mark_counts.h"

#include <deal.II/base/point.h>

#include <functional>
#include <vector>

namespace tetradapt::mechanics
{
  using dealii::Point;
  using dealii::Tensor;

  /**
   * Where in a box a function varies so fast that a quadrature rule on large cells may miss it:
   * jumps, peaks, short waves. The function is evaluated once, on a regular grid that does not
   * depend on any mesh; its second differences over one and over four steps tell.
   */
  class FeatureGrid
  {
  public:
    /** Calls an action with the corners of each tetrahedron that the function acts in. */
    using ForEachCell
      = std::function<void(const std::function<void(const std::array<Point<3>, 4> &)> &)>;

    /** Evaluates @p function at the grid's nodes in the box from @p lower to @p upper, which is
     * widened by a step on all sides. The step is @p step, or as much as @p most_nodes nodes
     * allow. Where the function throws core::InputError (outside of the body it need not have a
     * value), the grid says that it varies. @param cells tell which values count for the largest
     * and the mean. */
    FeatureGrid(const std::function<Tensor<1, 3>(const Point<3> &)> &function,
                const Point<3>                                      &lower,
                const Point<3>                                      &upper,
                double                                               step,
                std::size_t                                          most_nodes,
                const ForEachCell                                   &cells);

    /** The step that is used; larger than the one asked for if that took too many nodes. */
    double
    step() const
    {
      return used_step;
    }

    /** How long the edges of a part of a cell in a box may be for nothing to be missed, see
     * FeatureLevels; as where it varies fastest outside of the grid. */
    double
    part_size(const Point<3> &lower, const Point<3> &upper) const;

    /** Nodes around which the function varies fast. */
    std::size_t
    n_marks() const
    {
      return fine.n_marks();
    }

    /** Mean of |function| at the nodes in the cells. */
    double
    mean() const
    {
      return mean_size;
    }

  private:
    /** Marks the nodes in the cells; all, if there are none. */
    std::vector<char>
    nodes_in(const ForEachCell &cells) const;

    std::size_t
    node(unsigned int i, unsigned int j, unsigned int k) const
    {
      return (std::size_t(k) * n[1] + j) * n[0] + i;
    }

    Point<3>                    origin;
    double                      used_step = 0., mean_size = 0.;
    std::array<unsigned int, 3> n{}; ///< nodes in each direction
    MarkCounts                  fine, medium, coarse;
  };
} // namespace tetradapt::mechanics

#endif
