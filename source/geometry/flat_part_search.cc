// SPDX-License-Identifier: AGPL-3.0-or-later
#include "flat_part_search.h"

#include <algorithm>
#include <deque>
#include <limits>

namespace tetradapt::geometry
{
  namespace
  {
    constexpr unsigned int nothing = std::numeric_limits<unsigned int>::max();

    using Side = OutlineSide;

    Tensor<1, 3>
    unit_normal(const SurfaceMesh &surface, unsigned int triangle)
    {
      const auto &t = surface.triangles[triangle];
      const auto  n = dealii::cross_product_3d(surface.points[t[1]] - surface.points[t[0]],
                                              surface.points[t[2]] - surface.points[t[0]]);
      return n / n.norm();
    }

    std::vector<Side>
    sorted_sides(const SurfaceMesh &surface)
    {
      std::vector<Side> sides;
      sides.reserve(3 * surface.triangles.size());
      for (unsigned int t = 0; t < surface.triangles.size(); ++t)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int a = surface.triangles[t][i], b = surface.triangles[t][(i + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), t});
          }
      std::sort(sides.begin(), sides.end());
      return sides;
    }

    /** For each triangle the ones across its edges with the same id, where just two meet. */
    std::vector<std::array<unsigned int, 3>>
    neighbours(const SurfaceMesh &surface, const std::vector<Side> &sides)
    {
      std::vector<std::array<unsigned int, 3>> result(surface.triangles.size(),
                                                      {{nothing, nothing, nothing}});
      const auto                               put = [&](unsigned int t, unsigned int other) {
        *std::find(result[t].begin(), result[t].end(), nothing) = other;
      };
      for (std::size_t i = 0, next; i < sides.size(); i = next)
        {
          for (next = i + 1; next < sides.size() && sides[next].same_edge(sides[i]);)
            ++next;
          if (next != i + 2
              || (!surface.ids.empty()
                  && surface.ids[sides[i].triangle] != surface.ids[sides[i + 1].triangle]))
            continue;
          put(sides[i].triangle, sides[i + 1].triangle);
          put(sides[i + 1].triangle, sides[i].triangle);
        }
      return result;
    }
  } // namespace

  FlatPartList
  find_flat_parts(const SurfaceMesh &surface)
  {
    const auto   sides = sorted_sides(surface);
    const auto   next  = neighbours(surface, sides);
    FlatPartList parts;
    parts.of_triangle.assign(surface.triangles.size(), nothing);
    for (unsigned int seed = 0; seed < surface.triangles.size(); ++seed)
      {
        if (parts.of_triangle[seed] != nothing)
          continue;
        // Compared with the first triangle, so that slow curvature does not add up.
        const Tensor<1, 3>       normal = unit_normal(surface, seed);
        std::deque<unsigned int> queue{seed};
        parts.of_triangle[seed] = parts.triangles.size();
        parts.triangles.emplace_back();
        parts.normals.push_back(normal);
        for (; !queue.empty(); queue.pop_front())
          {
            parts.triangles.back().push_back(queue.front());
            for (const unsigned int t : next[queue.front()])
              if (t != nothing && parts.of_triangle[t] == nothing)
                {
                  const Tensor<1, 3> other = unit_normal(surface, t);
                  if (normal * other < 0.
                      || dealii::cross_product_3d(normal, other).norm() > flat_sine)
                    continue;
                  parts.of_triangle[t] = parts.triangles.size() - 1;
                  queue.push_back(t);
                }
          }
      }
    parts.outlines.resize(parts.triangles.size());
    parts.outline_neighbours.resize(surface.points.size());
    for (std::size_t i = 0, end; i < sides.size(); i = end)
      {
        for (end = i + 1; end < sides.size() && sides[end].same_edge(sides[i]);)
          ++end;
        if (end == i + 2
            && parts.of_triangle[sides[i].triangle] == parts.of_triangle[sides[i + 1].triangle])
          continue;
        for (std::size_t k = i; k < end; ++k)
          parts.outlines[parts.of_triangle[sides[k].triangle]].push_back(sides[k]);
        parts.outline_neighbours[sides[i].first].push_back(sides[i].second);
        parts.outline_neighbours[sides[i].second].push_back(sides[i].first);
      }
    return parts;
  }
} // namespace tetradapt::geometry
