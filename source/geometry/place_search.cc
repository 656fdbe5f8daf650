// SPDX-License-Identifier: AGPL-3.0-or-later
#include "place_search.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::geometry
{
  namespace
  {
    bool
    touches(const PartOfSurface &part, const Point<3> &point, const double snap)
    {
      return part.contains(point, snap)
             || std::any_of(part.outline().begin(), part.outline().end(), [&](const auto &side) {
                  return part.distance(side, point) <= snap;
                });
    }

    /** The pieces of a line in the part's plane that lie in the part. */
    std::vector<std::vector<Point<3>>>
    pieces_in_part(const PartOfSurface &part,
                   const Point<3>      &a,
                   const Point<3>      &b,
                   const double         snap)
    {
      const Tensor<1, 3> way    = b - a;
      const double       length = way.norm();
      const Tensor<1, 3> along  = way / length;
      const Tensor<1, 3> across = dealii::cross_product_3d(part.normal(), along);
      // Distances from a of where the outline meets the line.
      std::vector<double> cuts{0., length};
      const auto          add = [&](const double t) {
        if (t > 0. && t < length)
          cuts.push_back(t);
      };
      for (const OutlineSide &side : part.outline())
        {
          const Tensor<1, 3> first  = part.surface.points[side.first] - a,
                             second = part.surface.points[side.second] - a;
          const double u = first * across, v = second * across;
          if (std::abs(u) <= snap)
            add(first * along);
          if (std::abs(v) <= snap)
            add(second * along);
          if (std::abs(u) > snap && std::abs(v) > snap && (u < 0.) != (v < 0.))
            add((first + u / (u - v) * (second - first)) * along);
        }
      std::sort(cuts.begin(), cuts.end());
      std::vector<std::vector<Point<3>>> pieces;
      for (std::size_t i = 1; i < cuts.size(); ++i)
        if (cuts[i] - cuts[i - 1] > snap
            && part.contains(a + .5 * (cuts[i] + cuts[i - 1]) * along, snap))
          pieces.push_back({a + cuts[i - 1] * along, cuts[i] < length ? a + cuts[i] * along : b});
      return pieces;
    }
  } // namespace

  std::vector<std::vector<Point<3>>>
  place_in_part(const PartOfSurface &part, const SurfacePlace &place, const double snap)
  {
    const Point<3> &origin = part.surface.points[part.surface.triangles[part.triangles()[0]][0]];
    const auto      height = [&](const Point<3> &p) { return (p - origin) * part.normal(); };

    std::vector<std::vector<Point<3>>> result;
    std::vector<Point<3>>              in_plane;
    const auto                         add = [&](const Point<3> &point) {
      in_plane.push_back(point - height(point) * part.normal());
      if (touches(part, in_plane.back(), snap))
        result.push_back({in_plane.back()});
    };
    for (const Point<3> &end : place)
      if (std::abs(height(end)) <= snap)
        add(end);
    if (place.size() != 2)
      return result;
    const double a = height(place[0]), b = height(place[1]);
    if (in_plane.size() == 2)
      {
        const auto pieces = pieces_in_part(part, in_plane[0], in_plane[1], snap);
        result.insert(result.end(), pieces.begin(), pieces.end());
      }
    else if (std::abs(a) > snap && std::abs(b) > snap && (a < 0.) != (b < 0.))
      add(place[0] + a / (a - b) * (place[1] - place[0]));
    return result;
  }
} // namespace tetradapt::geometry
