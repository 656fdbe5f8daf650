// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_geometry_point_merger_h
#define tetradapt_source_geometry_point_merger_h

#include <deal.II/base/point.h>

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace tetradapt::geometry
{
  using dealii::Point;

  /** Numbers points; those that are as near as a tolerance get one number. */
  class PointMerger
  {
  public:
    explicit PointMerger(const double tolerance) : tolerance(tolerance)
    {
    }

    /** The number of @p point, which is a new one if none is near. */
    unsigned int
    number(const Point<3> &point)
    {
      const auto base = cell_of(point);
      for (std::int64_t i = -1; i <= 1; ++i)
        for (std::int64_t j = -1; j <= 1; ++j)
          for (std::int64_t k = -1; k <= 1; ++k)
            {
              const auto found = cells.find(key(base[0] + i, base[1] + j, base[2] + k));
              if (found != cells.end())
                for (const unsigned int p : found->second)
                  if (all[p].distance(point) <= tolerance)
                    return p;
            }
      return add(point);
    }

    /** Gives @p point a number of its own, near others or not. */
    unsigned int
    add(const Point<3> &point)
    {
      const auto base = cell_of(point);
      cells[key(base[0], base[1], base[2])].push_back(all.size());
      all.push_back(point);
      return all.size() - 1;
    }

    const std::vector<Point<3>> &
    points() const
    {
      return all;
    }

  private:
    std::array<std::int64_t, 3>
    cell_of(const Point<3> &point) const
    {
      std::array<std::int64_t, 3> cell{};
      for (unsigned int d = 0; d < 3; ++d)
        cell[d] = std::llround(std::floor(point[d] / (2. * tolerance)));
      return cell;
    }

    // Cells that share a key only cost a comparison.
    static std::uint64_t
    key(const std::int64_t i, const std::int64_t j, const std::int64_t k)
    {
      return static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15ULL
             + static_cast<std::uint64_t>(j) * 0xc2b2ae3d27d4eb4fULL
             + static_cast<std::uint64_t>(k) * 0x165667b19e3779f9ULL;
    }

    double                                                       tolerance;
    std::vector<Point<3>>                                        all;
    std::unordered_map<std::uint64_t, std::vector<unsigned int>> cells;
  };
} // namespace tetradapt::geometry

#endif
