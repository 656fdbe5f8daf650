// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexahedral_selection.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/plc.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::solve::hexahedral
{
  namespace
  {
    constexpr double       same_plane      = 1e-7; ///< relative to the body's extent
    constexpr double       same_area       = 1e-6; ///< relative to the body's surface
    constexpr unsigned int most_new_planes = 64;

    /** Where along a line across a rectangle the expression changes: the last
     * coordinates, by bisection, at which it still holds. */
    void
    add_changes(const Selection     &selection,
                const Rectangle     &r,
                const bool           along_first,
                const double         across,
                std::vector<double> &coordinates)
    {
      constexpr unsigned int n    = 16;
      const unsigned int     axis = (r.first_axis() + (along_first ? 0 : 1)) % 3;
      const auto at = [&](double s) { return along_first ? r.at(s, across) : r.at(across, s); };
      for (unsigned int k = 0; k < n; ++k)
        {
          double     from = double(k) / n, to = (k + 1.) / n;
          const bool first = selection.holds(at(from));
          if (selection.holds(at(to)) == first)
            continue;
          for (unsigned int step = 0; step < 60; ++step)
            {
              const double middle                                = .5 * (from + to);
              (selection.holds(at(middle)) == first ? from : to) = middle;
            }
          coordinates.push_back(at(first ? from : to)[axis]);
        }
    }

    /** Planes on which the expression changes: those met on several lines. */
    std::array<std::vector<double>, 3>
    change_planes(const Selection              &selection,
                  const std::vector<Rectangle> &rectangles,
                  double                        tolerance)
    {
      std::array<std::vector<double>, 3> result;
      for (const auto &r : rectangles)
        if (selection.lists(r.side))
          for (const bool along_first : {true, false})
            {
              std::vector<double> found;
              for (const double across : {.11, .29, .53, .71, .89})
                add_changes(selection, r, along_first, across, found);
              std::sort(found.begin(), found.end());
              for (unsigned int i = 1; i < found.size(); ++i)
                if (found[i] - found[i - 1] <= tolerance)
                  result[(r.first_axis() + (along_first ? 0 : 1)) % 3].push_back(found[i - 1]);
            }
      return result;
    }

    bool
    is_resolved(const Selection &selection, const std::vector<Rectangle> &rectangles)
    {
      constexpr unsigned int n = 7;
      for (const auto &r : rectangles)
        if (selection.lists(r.side))
          {
            const bool selected = selection.selects(r);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                if (selection.holds(r.at((i + .5) / n, (j + .5) / n)) != selected)
                  return false;
          }
      return true;
    }
  } // namespace

  Point<3>
  Rectangle::at(const double s, const double t) const
  {
    const unsigned int first = first_axis(), second = (first + 1) % 3;
    Point<3>           p = lower;
    // In this form both ends are exact.
    p[first]  = (1. - s) * lower[first] + s * upper[first];
    p[second] = (1. - t) * lower[second] + t * upper[second];
    return p;
  }

  double
  Rectangle::area() const
  {
    const unsigned int first = first_axis(), second = (first + 1) % 3;
    return (upper[first] - lower[first]) * (upper[second] - lower[second]);
  }

  Rectangle
  rectangle(const HexahedralGrid &grid, const unsigned int brick, const unsigned int side)
  {
    const unsigned int d = side / 2;
    Rectangle          r{brick, side, grid.corner(brick, 0), grid.corner(brick, 7)};
    if (side % 2 == 1)
      r.lower[d] = r.upper[d];
    else
      r.upper[d] = r.lower[d];
    return r;
  }

  std::vector<Rectangle>
  boundary(const HexahedralGrid &grid)
  {
    std::vector<Rectangle>            result;
    const std::array<unsigned int, 3> stride{{1, grid.size(0), grid.size(0) * grid.size(1)}};
    for (unsigned int brick = 0; brick < grid.n_bricks(); ++brick)
      for (unsigned int side = 0; grid.filled[brick] && side < 6; ++side)
        {
          const unsigned int d = side / 2, i = grid.position(brick)[d];
          const bool         upper = side % 2 == 1;
          const bool         ends  = upper ? i + 1 == grid.size(d) : i == 0;
          if (ends || !grid.filled[upper ? brick + stride[d] : brick - stride[d]])
            result.push_back(rectangle(grid, brick, side));
        }
    return result;
  }

  double
  extent(const HexahedralGrid &grid)
  {
    double result = 0.;
    for (const auto &along : grid.planes)
      result = std::max(result, along.back() - along.front());
    return result;
  }

  unsigned int
  brick_around(const HexahedralGrid &grid, const HexahedralGrid &finer, const unsigned int inner)
  {
    const Point<3> lower = finer.corner(inner, 0), upper = finer.corner(inner, 7);
    unsigned int   i[3];
    for (unsigned int d = 0; d < 3; ++d)
      i[d] = std::upper_bound(grid.planes[d].begin(),
                              grid.planes[d].end(),
                              lower[d] + .5 * (upper[d] - lower[d]))
             - grid.planes[d].begin() - 1;
    return i[0] + grid.size(0) * (i[1] + grid.size(1) * i[2]);
  }

  HexahedralGrid
  with_planes(const HexahedralGrid &old, const std::array<std::vector<double>, 3> &planes)
  {
    HexahedralGrid grid;
    grid.planes = planes;
    grid.filled.resize(std::size_t(grid.size(0)) * grid.size(1) * grid.size(2));
    grid.regions.resize(grid.filled.size());
    for (unsigned int brick = 0; brick < grid.n_bricks(); ++brick)
      {
        const unsigned int parent = brick_around(old, grid, brick);
        grid.filled[brick]        = old.filled[parent];
        grid.regions[brick]       = old.regions[parent];
      }
    return grid;
  }

  void
  merge_planes(std::array<std::vector<double>, 3>       &planes,
               const std::array<std::vector<double>, 3> &others,
               const double                              extent)
  {
    for (unsigned int d = 0; d < 3; ++d)
      {
        for (const double x : others[d])
          if (std::none_of(planes[d].begin(), planes[d].end(), [&](double y) {
                return std::abs(x - y) <= same_plane * extent;
              }))
            planes[d].push_back(x);
        std::sort(planes[d].begin(), planes[d].end());
      }
  }

  Selection::Selection(const std::string &name, const scene::Selector &selector)
    : full_name(name), selector(selector)
  {
    if (!selector.where.empty())
      expression = std::make_unique<core::Condition>(selector.where, name + "/Where");
  }

  bool
  Selection::lists(const unsigned int side) const
  {
    const auto patch = mesh::box_patches()[side];
    return (selector.ids.empty() && selector.groups.empty())
           || std::count(selector.ids.begin(), selector.ids.end(), patch.boundary_id) > 0
           || std::count(selector.groups.begin(), selector.groups.end(), patch.name) > 0;
  }

  bool
  Selection::holds(const Point<3> &p) const
  {
    return expression == nullptr || expression->holds(p);
  }

  bool
  Selection::selects(const Rectangle &r) const
  {
    return lists(r.side) && holds(r.at(0, 0)) && holds(r.at(1, 0)) && holds(r.at(0, 1))
           && holds(r.at(1, 1)) && holds(r.at(.5, .5));
  }

  double
  Selection::area(const std::vector<Rectangle> &rectangles) const
  {
    double sum = 0.;
    for (const auto &r : rectangles)
      if (selects(r))
        sum += r.area();
    return sum;
  }

  HexahedralGrid
  resolved(const HexahedralGrid &grid,
           const Selection      &selection,
           const double          wanted_area,
           const core::Log      &log)
  {
    auto   rectangles = boundary(grid);
    double surface    = 0.;
    for (const auto &r : rectangles)
      surface += r.area();
    const auto agrees
      = [&] { return std::abs(selection.area(rectangles) - wanted_area) <= same_area * surface; };
    if (!selection.is_spatial() || agrees())
      return grid;
    auto planes = grid.planes;
    merge_planes(planes,
                 change_planes(selection, rectangles, same_plane * extent(grid)),
                 extent(grid));
    const auto count = [](const auto &p) { return p[0].size() + p[1].size() + p[2].size(); };
    if (count(planes) > count(grid.planes) + most_new_planes)
      planes = grid.planes;
    const HexahedralGrid finer = with_planes(grid, planes);
    rectangles                 = boundary(finer);
    if (agrees())
      return finer;
    if (!is_resolved(selection, rectangles))
      throw core::InputError(
        selection.name()
        + "/Where: the border of what it selects does not lie in planes parallel to the axes, so "
          "no hexahedra can follow it. Select sides by Groups or Ids, or compare coordinates with "
          "numbers, with a little room for rounding, such as x < 0.5 + 1e-9; or use "
          "Reference/Type = fine mesh.");
    std::ostringstream text;
    text << selection.name() << " selects an area of " << selection.area(rectangles)
         << " on the hexahedral reference, but of " << wanted_area
         << " on the scene's first mesh, whose triangles do not follow the border. The error "
            "measured includes the difference.";
    log.warning(text.str());
    return finer;
  }
} // namespace tetradapt::solve::hexahedral
