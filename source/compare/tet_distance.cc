// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/tet_distance.h"

#include <algorithm>
#include <limits>

namespace tetradapt::compare
{
  using dealii::Tensor;

  namespace
  {
    /** Projection onto the triangle's plane as weights of b and c; false if the
     * triangle has no plane or the projection lies outside. */
    bool
    project(
      const Tensor<1, 3> &ap, const Tensor<1, 3> &ab, const Tensor<1, 3> &ac, double &v, double &w)
    {
      const Tensor<1, 3> n  = dealii::cross_product_3d(ab, ac);
      const double       nn = n * n;
      if (!(nn > 0.))
        return false;
      v = (dealii::cross_product_3d(ap, ac) * n) / nn;
      w = (dealii::cross_product_3d(ab, ap) * n) / nn;
      return v >= 0. && w >= 0. && v + w <= 1.;
    }
  } // namespace

  ClosestPoint
  closest_point_on_triangle(const Point<3> &p,
                            const Point<3> &a,
                            const Point<3> &b,
                            const Point<3> &c)
  {
    ClosestPoint       best;
    const Tensor<1, 3> ap = p - a, ab = b - a, ac = c - a;
    double             v = 0., w = 0.;
    if (project(ap, ab, ac, v, w))
      {
        best.weights          = {{1. - v - w, v, w}};
        best.squared_distance = (ap - v * ab - w * ac).norm_square();
        return best;
      }
    best.squared_distance = std::numeric_limits<double>::max();
    const std::array<const Point<3> *, 3> corners{{&a, &b, &c}};
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int j        = (i + 1) % 3;
        const Tensor<1, 3> edge     = *corners[j] - *corners[i];
        const Tensor<1, 3> to_p     = p - *corners[i];
        const double       length_2 = edge.norm_square();
        const double t = length_2 > 0. ? std::min(std::max((to_p * edge) / length_2, 0.), 1.) : 0.;
        const double distance_2 = (to_p - t * edge).norm_square();
        if (distance_2 < best.squared_distance)
          {
            best.squared_distance = distance_2;
            best.weights          = {{0., 0., 0.}};
            best.weights[i]       = 1. - t;
            best.weights[j] += t;
          }
      }
    return best;
  }
} // namespace tetradapt::compare
