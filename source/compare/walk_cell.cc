// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/walk_cell.h"

#include <cmath>
#include <limits>

namespace tetradapt::compare::internal
{
  double
  WalkCell::height(const unsigned int i) const
  {
    double square = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const double g
          = i > 0 ? gradient[i - 1][d] : gradient[0][d] + gradient[1][d] + gradient[2][d];
        square += g * g;
      }
    return 1. / std::sqrt(square);
  }

  void
  WalkCell::set_geometry(const std::array<const Point<3> *, 4> &v, const double tolerance)
  {
    const Tensor<1, 3> a = *v[1] - *v[0], b = *v[2] - *v[0], c = *v[3] - *v[0];
    const Tensor<1, 3> normals[3] = {dealii::cross_product_3d(b, c),
                                     dealii::cross_product_3d(c, a),
                                     dealii::cross_product_3d(a, b)};
    const double       inverse    = 1. / (a * normals[0]);
    const double       scale
      = std::isfinite(inverse) ? inverse : std::numeric_limits<double>::quiet_NaN();
    double       largest = 0.;
    Tensor<1, 3> sum;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const Tensor<1, 3> g = scale * normals[i];
        sum += g;
        largest = std::max(largest, g.norm());
        for (unsigned int d = 0; d < 3; ++d)
          gradient[i][d] = g[d];
        origin[i] = (*v[0])[i];
      }
    margin = tolerance * std::max(largest, sum.norm());
  }

  Location
  clamped(const unsigned int cell, const mesh::Barycentric &b)
  {
    Location result;
    result.cell = cell;
    double sum  = 0.;
    for (unsigned int i = 0; i < 4; ++i)
      sum += result.barycentric[i] = std::max(b[i], 0.);
    for (double &x : result.barycentric)
      x /= sum;
    return result;
  }
} // namespace tetradapt::compare::internal
