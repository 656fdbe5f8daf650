// SPDX-License-Identifier: AGPL-3.0-or-later
#include "selection_borders.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tetradapt::mesh
{
  namespace
  {
    using Kind = core::ConditionLeaf::Kind;

    /** By an edge's length, how far its ends may be from the border that it follows: a chord
     * that turns by 30 degrees and was cut into four is off by 0.26. */
    constexpr double near = 0.3;

    /** An edge of the boundary and one of its faces. */
    struct Side
    {
      unsigned int first, second, face;
    };

    std::vector<Side>
    sorted_sides(const TetMesh &mesh)
    {
      std::vector<Side> sides;
      sides.reserve(3 * mesh.faces.size());
      for (unsigned int f = 0; f < mesh.faces.size(); ++f)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const auto [a, b]
              = std::minmax(mesh.faces[f].vertices[i], mesh.faces[f].vertices[(i + 1) % 3]);
            sides.push_back({a, b, f});
          }
      std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) {
        return a.first != b.first ? a.first < b.first : a.second < b.second;
      });
      return sides;
    }

    /** What one patch is selected by and the other is not. */
    std::vector<std::string>
    differences(const Patch &a, const Patch &b)
    {
      std::vector<std::string>    result;
      const std::set<std::string> first(a.selections.begin(), a.selections.end());
      const std::set<std::string> second(b.selections.begin(), b.selections.end());
      std::set_symmetric_difference(
        first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(result));
      return result;
    }
  } // namespace

  LocalPlane
  LeafSurface::plane_near(const Point<3> &point, const double length) const
  {
    if (leaf.kind == Kind::affine)
      return {leaf.level(point), leaf.normal};
    return plane_of_zero_set([this](const Point<3> &p) { return leaf.level(p); }, point, length);
  }

  SelectionBorders::SelectionBorders(
    const std::vector<std::pair<std::string, scene::Selector>> &selectors)
  {
    for (const auto &[name, selector] : selectors)
      {
        if (selector.where.empty())
          continue;
        const core::Condition condition(selector.where, name + "/Where");
        for (const auto &leaf : condition.leaves())
          if (leaf.kind != Kind::constant && leaf.kind != Kind::truth)
            leaves[name].push_back(std::make_unique<LeafSurface>(leaf));
      }
  }

  const CurvedSurface *
  SelectionBorders::along_edge(const std::string &selection,
                               const Point<3>    &a,
                               const Point<3>    &b) const
  {
    const auto found = leaves.find(selection);
    if (found == leaves.end())
      return nullptr;
    const CurvedSurface *nearest  = nullptr;
    double               distance = near * a.distance(b);
    for (const auto &leaf : found->second)
      {
        double farther = 0.;
        for (const Point<3> &end : {a, b})
          {
            const LocalPlane plane = leaf->plane_near(end, a.distance(b));
            farther                = std::max(farther,
                               plane.normal.norm_square() > 0. ? std::abs(plane.distance)
                                                                              : a.distance(b));
          }
        if (farther <= distance)
          {
            distance = farther;
            nearest  = leaf.get();
          }
      }
    return nearest;
  }

  std::map<unsigned int, std::vector<const CurvedSurface *>>
  SelectionBorders::through_points(const TetMesh &mesh, const double crease_angle) const
  {
    std::map<unsigned int, std::vector<const CurvedSurface *>> result;
    if (leaves.empty())
      return result;
    const double least_cosine = std::cos(crease_angle * dealii::numbers::PI / 180.);
    const auto   sides        = sorted_sides(mesh);
    for (std::size_t i = 0; i + 1 < sides.size(); ++i)
      {
        const Side &side = sides[i], &other = sides[i + 1];
        if (side.first != other.first || side.second != other.second)
          continue;
        const BoundaryFace &f = mesh.faces[side.face], &g = mesh.faces[other.face];
        if (f.patch == g.patch)
          continue;
        const Tensor<1, 3> a = face_area_vector(mesh, f), b = face_area_vector(mesh, g);
        if (a * b < least_cosine * a.norm() * b.norm())
          continue;
        for (const std::string &selection :
             differences(mesh.patches[f.patch], mesh.patches[g.patch]))
          if (const CurvedSurface *border
              = along_edge(selection, mesh.points[side.first], mesh.points[side.second]))
            for (const unsigned int p : {side.first, side.second})
              {
                auto &at_point = result[p];
                if (std::find(at_point.begin(), at_point.end(), border) == at_point.end())
                  at_point.push_back(border);
              }
      }
    return result;
  }
} // namespace tetradapt::mesh
