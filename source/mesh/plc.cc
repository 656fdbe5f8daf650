// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/plc.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    constexpr double flattest_box = 1e-3; ///< shortest side by longest

    /** Digits of a coordinate that the shortest side must be left with. */
    constexpr double least_precision = 1e-4;

    /** A box far from the origin has none. */
    void
    check_place(const Point<3> &lower, const Point<3> &upper)
    {
      for (unsigned int d = 0; d < 3; ++d)
        {
          const double farthest = std::max(std::abs(lower[d]), std::abs(upper[d]));
          const double rounding = std::numeric_limits<double>::epsilon() * farthest;
          if (!(rounding > least_precision * (upper[d] - lower[d])))
            continue;
          std::ostringstream message;
          message << "The box is too far from the origin for its size: a coordinate of " << farthest
                  << " is rounded by " << rounding << ", and the side along "
                  << "xyz"[d] << " is " << upper[d] - lower[d] << ". Move the box to the origin.";
          throw core::InputError(message.str());
        }
    }

    void
    check_box(const Point<3> &lower, const Point<3> &upper)
    {
      constexpr char axes[] = "xyz";
      for (unsigned int d = 0; d < 3; ++d)
        {
          std::ostringstream message;
          if (!std::isfinite(lower[d]) || !std::isfinite(upper[d]))
            message << "The box's corners must be finite numbers";
          else if (upper[d] <= lower[d])
            message << "The box has no extent along " << axes[d] << ": from " << lower[d] << " to "
                    << upper[d]
                    << ". Mesh/Upper corner must be above Mesh/Lower corner in every direction";
          else
            continue;
          message << '.';
          throw core::InputError(message.str());
        }
      check_place(lower, upper);
      const Tensor<1, 3> size     = upper - lower;
      const double       shortest = std::min({size[0], size[1], size[2]});
      const double       longest  = std::max({size[0], size[1], size[2]});
      if (!std::isfinite(longest) || shortest < flattest_box * longest)
        {
          std::ostringstream message;
          message << "The box is nearly flat: its sides are " << size[0] << ", " << size[1]
                  << " and " << size[2] << ", and TetGen may not finish below a ratio of 1 "
                  << "to " << 1. / flattest_box
                  << ". Make it thicker or smaller, or use bricks (Mesh/Type = bricks).";
          throw core::InputError(message.str());
        }
    }
  } // namespace

  PiecewiseLinearComplex
  box_complex(const Point<3> &lower, const Point<3> &upper)
  {
    check_box(lower, upper);
    PiecewiseLinearComplex plc;
    plc.name             = "the box";
    plc.volume_tolerance = 1e-9;
    for (unsigned int i = 0; i < 8; ++i)
      plc.points.emplace_back((i & 1) != 0 ? upper[0] : lower[0],
                              (i & 2) != 0 ? upper[1] : lower[1],
                              (i & 4) != 0 ? upper[2] : lower[2]);
    // Counter-clockwise seen from outside.
    plc.facets  = {{{0, 4, 6, 2}, 0},
                   {{1, 3, 7, 5}, 1},
                   {{0, 1, 5, 4}, 2},
                   {{2, 6, 7, 3}, 3},
                   {{0, 2, 3, 1}, 4},
                   {{4, 5, 7, 6}, 5}};
    plc.patches = box_patches();
    return plc;
  }

  std::vector<Patch>
  box_patches()
  {
    std::vector<Patch> patches;
    int                id = 0;
    for (const char *name : {"x-min", "x-max", "y-min", "y-max", "z-min", "z-max"})
      {
        Patch patch;
        patch.boundary_id = ++id;
        patch.name        = name;
        patches.push_back(patch);
      }
    return patches;
  }

  PiecewiseLinearComplex
  surface_complex(const geometry::SurfaceMesh &surface, const std::string &name)
  {
    PiecewiseLinearComplex plc;
    plc.name   = name;
    plc.points = surface.points;
    std::map<int, unsigned int> patch_of_id;
    for (const int id : surface.ids)
      patch_of_id[id] = 0;
    if (surface.ids.empty())
      patch_of_id[0] = 0;
    for (auto &[id, patch] : patch_of_id)
      {
        patch = plc.patches.size();
        Patch new_patch;
        new_patch.boundary_id = id;
        plc.patches.push_back(new_patch);
      }
    plc.facets.reserve(surface.triangles.size());
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
      {
        const auto &t = surface.triangles[i];
        plc.facets.push_back(
          {{t[0], t[1], t[2]}, patch_of_id.at(surface.ids.empty() ? 0 : surface.ids[i])});
      }
    return plc;
  }

  geometry::SurfaceMesh
  triangulate(const PiecewiseLinearComplex &plc)
  {
    geometry::SurfaceMesh surface;
    surface.points = plc.points;
    for (const auto &facet : plc.facets)
      for (std::size_t i = 2; facet.patch != plc.inner && i < facet.vertices.size(); ++i)
        {
          surface.triangles.push_back(
            {{facet.vertices[0], facet.vertices[i - 1], facet.vertices[i]}});
          surface.ids.push_back(facet.patch);
        }
    return surface;
  }
} // namespace tetradapt::mesh
