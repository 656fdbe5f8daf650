// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_triangle_features_h
#define tetradapt_mechanics_triangle_features_h

#include "tetradapt/mechanics/density_sampler.h"
#include "tetradapt/mechanics/mark_counts.h"

namespace tetradapt::mechanics
{
  /** Where on a triangle a function varies so fast that a quadrature rule may miss it: as
   * FeatureGrid does in the volume, on a lattice of the triangle. */
  class TriangleFeatures
  {
  public:
    /** Evaluates @p density on a lattice with steps of at most @p step along the edges, a little
     * inside of the triangle. @param largest value of |density| on all of the surface. */
    TriangleFeatures(const std::array<Point<3>, 3>     &corners,
                     const DensitySampler<3>::Function &density,
                     double                             step,
                     double                             largest);

    /** How long the edges of a part, with corners in barycentric coordinates, may be for nothing
     * to be missed. */
    double
    part_size(const mesh::PartCorners<3> &part) const;

    /** Points of the lattice around which the density varies fast. */
    std::size_t
    n_marks() const
    {
      return fine.n_marks();
    }

  private:
    unsigned int n = 0; ///< steps along an edge
    double       step;
    MarkCounts   fine, medium, coarse;
  };
} // namespace tetradapt::mechanics

#endif
