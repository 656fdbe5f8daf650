// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/blocks.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    using Index = std::array<int, 3>;
    using Boxes = std::vector<std::pair<Point<3>, Point<3>>>;

    /** Parts of the body's extent: coordinates closer than the first are the same,
     * those closer than the second are refused. */
    constexpr double same_plane    = 1e-9;
    constexpr double closest_plane = 1e-4;
    constexpr double most_cells    = 1e7; ///< of the grid

    template <typename... Parts>
    [[noreturn]] void
    refuse(const Parts &...parts)
    {
      std::ostringstream text;
      text << "Mesh/Blocks: ";
      (text << ... << parts);
      throw core::InputError(text.str());
    }

    double
    extent(const Boxes &blocks)
    {
      double result = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        {
          double lowest = blocks[0].first[d], highest = blocks[0].second[d];
          for (unsigned int b = 0; b < blocks.size(); ++b)
            {
              if (!std::isfinite(blocks[b].first[d]) || !std::isfinite(blocks[b].second[d]))
                refuse("the corners of block ", b + 1, " must be finite numbers.");
              lowest  = std::min(lowest, blocks[b].first[d]);
              highest = std::max(highest, blocks[b].second[d]);
            }
          result = std::max(result, highest - lowest);
        }
      if (!std::isfinite(result))
        refuse("the body is too large for a number.");
      return result;
    }

    /** All coordinates along one axis, equal ones once. */
    std::vector<double>
    planes(const Boxes &blocks, const unsigned int d, const double extent)
    {
      std::vector<double> all, result;
      for (const auto &[lower, upper] : blocks)
        all.insert(all.end(), {lower[d], upper[d]});
      std::sort(all.begin(), all.end());
      for (const double x : all)
        if (result.empty() || x - result.back() > same_plane * extent)
          result.push_back(x);
      for (unsigned int i = 1; i < result.size(); ++i)
        if (result[i] - result[i - 1] < closest_plane * extent)
          refuse("the coordinates ",
                 "xyz"[d],
                 " = ",
                 result[i - 1],
                 " and ",
                 result[i],
                 " are too close to each other for a body of extent ",
                 extent,
                 ": TetGen may not finish. Make them equal, or move them apart.");
      return result;
    }

    /** Number of the plane at @p x. */
    int
    plane_number(const std::vector<double> &planes, const double x, const double extent)
    {
      return std::lower_bound(planes.begin(), planes.end(), x - same_plane * extent)
             - planes.begin();
    }

    unsigned int
    block_at(const BlockGrid &grid, const Index &i)
    {
      return grid.block(i[0], i[1], i[2]);
    }

    Point<3>
    point_at(const BlockGrid &grid, const Index &i)
    {
      return {grid.coordinates[0][i[0]], grid.coordinates[1][i[1]], grid.coordinates[2][i[2]]};
    }

    /** The inner edges and points of the grid: where the cells of the body, or those
     * outside, around one do not hang together across faces, parts touch there only. */
    void
    check_contact(const BlockGrid &grid, const Index &point)
    {
      bool         inside[8];
      unsigned int blocks[2] = {BlockGrid::outside, BlockGrid::outside};
      for (unsigned int c = 0; c < 8; ++c)
        {
          const unsigned int block = grid.block(point[0] - 1 + (c & 1),
                                                point[1] - 1 + (c >> 1 & 1),
                                                point[2] - 1 + (c >> 2));
          inside[c]                = block != BlockGrid::outside;
          if (inside[c] && blocks[0] == BlockGrid::outside)
            blocks[0] = block;
          else if (inside[c] && block != blocks[0])
            blocks[1] = block;
        }
      for (const bool kind : {true, false})
        {
          unsigned int reached = 0, all = 0; // sets of cells, one bit each
          for (unsigned int c = 0; c < 8; ++c)
            if (inside[c] == kind)
              {
                all |= 1u << c;
                if (reached == 0)
                  reached = 1u << c;
              }
          for (unsigned int round = 0; round < 8; ++round)
            for (unsigned int c = 0; c < 8; ++c)
              for (unsigned int d = 0; d < 3; ++d)
                if ((reached >> c & 1) != 0 && inside[c ^ (1u << d)] == kind)
                  reached |= 1u << (c ^ (1u << d));
          if (reached != all)
            refuse("blocks ",
                   std::min(blocks[0], blocks[1]) + 1,
                   " and ",
                   std::max(blocks[0], blocks[1]) + 1,
                   " touch along an edge or in a point at ",
                   to_string(point_at(grid, point)),
                   " without a common face there. Let them share a face, or move them apart.");
        }
    }

    template <typename Function>
    void
    for_each(const Index &end, const Function &function)
    {
      Index i;
      for (i[2] = 0; i[2] < end[2]; ++i[2])
        for (i[1] = 0; i[1] < end[1]; ++i[1])
          for (i[0] = 0; i[0] < end[0]; ++i[0])
            function(i);
    }

    /** A point in every part of the body that has one region id. */
    std::vector<PiecewiseLinearComplex::Region>
    find_regions(const BlockGrid &grid, const std::vector<int> &region_of_block)
    {
      std::vector<PiecewiseLinearComplex::Region> result;
      const Index                                 end{{grid.size(0), grid.size(1), grid.size(2)}};
      const std::size_t                           n_blocks = std::size_t(end[0]) * end[1] * end[2];
      std::vector<bool>                           seen(n_blocks, false);
      const auto                                  number = [&](const Index &i) {
        return i[0] + std::size_t(end[0]) * (i[1] + std::size_t(end[1]) * i[2]);
      };
      std::vector<Index> stack;
      for_each(end, [&](const Index &start) {
        if (block_at(grid, start) == BlockGrid::outside || seen[number(start)])
          return;
        const int region = region_of_block[block_at(grid, start)];
        Point<3>  centre;
        for (unsigned int d = 0; d < 3; ++d)
          centre[d] = .5 * (grid.coordinates[d][start[d]] + grid.coordinates[d][start[d] + 1]);
        result.push_back({centre, region});
        seen[number(start)] = true;
        stack.push_back(start);
        while (!stack.empty())
          {
            const Index cell = stack.back();
            stack.pop_back();
            for (unsigned int side = 0; side < 6; ++side)
              {
                Index other = cell;
                other[side / 2] += side % 2 == 0 ? -1 : 1;
                const unsigned int block = block_at(grid, other);
                if (block == BlockGrid::outside || region_of_block[block] != region
                    || seen[number(other)])
                  continue;
                seen[number(other)] = true;
                stack.push_back(other);
              }
          }
      });
      return result;
    }
  } // namespace

  BlockGrid::BlockGrid(const std::vector<std::pair<Point<3>, Point<3>>> &blocks)
    : block_count(blocks.size())
  {
    if (blocks.empty())
      refuse("give at least one box, such as 0,0,0 : 1,1,1.");
    const double size_of_body = extent(blocks);
    double       n            = 1.;
    for (unsigned int d = 0; d < 3; ++d)
      {
        coordinates[d] = planes(blocks, d, size_of_body);
        n *= coordinates[d].size() - 1.;
      }
    if (n > most_cells)
      refuse("the coordinates of the blocks divide space into ", n, " boxes. Use fewer blocks.");
    cells.assign(static_cast<std::size_t>(n), outside);
    for (unsigned int b = 0; b < blocks.size(); ++b)
      {
        Index from, to;
        for (unsigned int d = 0; d < 3; ++d)
          {
            from[d] = plane_number(coordinates[d], blocks[b].first[d], size_of_body);
            to[d]   = plane_number(coordinates[d], blocks[b].second[d], size_of_body);
            if (from[d] >= to[d])
              refuse("block ", b + 1, " has no extent along ", "xyz"[d], '.');
          }
        Index i;
        for (i[2] = from[2]; i[2] < to[2]; ++i[2])
          for (i[1] = from[1]; i[1] < to[1]; ++i[1])
            for (i[0] = from[0]; i[0] < to[0]; ++i[0])
              {
                unsigned int &cell
                  = cells[i[0] + std::size_t(size(0)) * (i[1] + std::size_t(size(1)) * i[2])];
                if (cell != outside)
                  refuse(
                    "blocks ", cell + 1, " and ", b + 1, " overlap. They may share faces only.");
                cell = b;
              }
      }
    for_each({{size(0) + 1, size(1) + 1, size(2) + 1}},
             [&](const Index &point) { check_contact(*this, point); });
  }

  PiecewiseLinearComplex
  blocks_complex(const BlockGrid &grid, const std::vector<int> &regions)
  {
    PiecewiseLinearComplex plc;
    plc.name             = "the blocks";
    plc.volume_tolerance = 1e-9;
    plc.patches          = box_patches();
    const std::vector<int> region_of_block
      = regions.empty() ? std::vector<int>(grid.n_blocks(), 0) : regions;
    if (std::any_of(region_of_block.begin(), region_of_block.end(), [](int id) { return id != 0; }))
      plc.regions = find_regions(grid, region_of_block);

    std::map<Index, unsigned int> numbers;
    const auto                    number = [&](const Index &i) {
      const auto [entry, is_new] = numbers.emplace(i, plc.points.size());
      if (is_new)
        plc.points.push_back(point_at(grid, i));
      return entry->second;
    };
    for_each({{grid.size(0), grid.size(1), grid.size(2)}}, [&](const Index &cell) {
      const unsigned int block = block_at(grid, cell);
      if (block == BlockGrid::outside)
        return;
      for (unsigned int side = 0; side < 6; ++side)
        {
          const unsigned int d     = side / 2;
          const bool         upper = side % 2 == 1;
          Index              other = cell;
          other[d] += upper ? 1 : -1;
          const unsigned int beyond = block_at(grid, other);
          const bool         outer  = beyond == BlockGrid::outside;
          if (!outer && (!upper || region_of_block[beyond] == region_of_block[block]))
            continue;
          // Counter-clockwise seen along the axis from above.
          std::array<Index, 4> corners{{cell, cell, cell, cell}};
          for (unsigned int k = 0; k < 4; ++k)
            {
              corners[k][d] += upper;
              corners[k][(d + 1) % 3] += k == 1 || k == 2;
              corners[k][(d + 2) % 3] += k >= 2;
            }
          PiecewiseLinearComplex::Facet facet;
          facet.patch = outer ? side : PiecewiseLinearComplex::inner;
          for (unsigned int k = 0; k < 4; ++k)
            facet.vertices.push_back(number(corners[upper ? k : 3 - k]));
          plc.facets.push_back(facet);
        }
    });
    return plc;
  }
} // namespace tetradapt::mesh
