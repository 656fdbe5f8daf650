// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/tetgen_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetradapt::mesh
{
  namespace
  {
    /** A body farther from the origin than this many times its extent is moved. A
     * difference of two numbers within a factor of two of each other is exact. */
    constexpr double far_away = 8.;
  } // namespace

  TetgenFrame::TetgenFrame(const std::vector<double> &points)
  {
    std::array<double, 3> lower, upper;
    lower.fill(std::numeric_limits<double>::max());
    upper.fill(std::numeric_limits<double>::lowest());
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        lower[i % 3] = std::min(lower[i % 3], points[i]);
        upper[i % 3] = std::max(upper[i % 3], points[i]);
      }
    double extent = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      extent = std::max(extent, upper[d] - lower[d]);
    if (!(extent > 0.) || !std::isfinite(extent))
      return;
    std::frexp(extent, &exponent);
    exponent = -exponent;
    for (unsigned int d = 0; d < 3; ++d)
      if (std::min(std::abs(lower[d]), std::abs(upper[d])) > far_away * extent)
        origin[d] = lower[d];
  }

  void
  TetgenFrame::enter(TetgenRequest &request) const
  {
    for (std::size_t i = 0; i < request.points.size(); ++i)
      request.points[i] = std::ldexp(request.points[i] - origin[i % 3], exponent);
    for (double &size : request.point_sizes)
      size = std::ldexp(size, exponent);
    for (double &bound : request.tet_volumes)
      bound = volume(bound);
    for (std::size_t region = 0; region + 4 < request.regions.size(); region += 5)
      for (unsigned int d = 0; d < 3; ++d)
        request.regions[region + d] = std::ldexp(request.regions[region + d] - origin[d], exponent);
  }

  void
  TetgenFrame::leave(TetgenReply &reply) const
  {
    for (std::size_t i = 0; i < reply.points.size(); ++i)
      reply.points[i] = std::ldexp(reply.points[i], -exponent) + origin[i % 3];
  }

  double
  TetgenFrame::volume(const double volume) const
  {
    return std::ldexp(volume, 3 * exponent);
  }
} // namespace tetradapt::mesh
