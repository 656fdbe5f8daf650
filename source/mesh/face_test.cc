// SPDX-License-Identifier: AGPL-3.0-or-later
#include "face_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetradapt::mesh
{
  namespace
  {
    using Kind = core::ConditionLeaf::Kind;

    /** By the body's extent: a border as near to a corner passes through it, ... */
    constexpr double same_point = 1e-6;
    /** ... and faces up to this size are looked at in their corners and centre only. */
    constexpr double scan_distance = 1e-2;
    /** Into how many parts the edges of a face are divided for sampling. */
    constexpr unsigned int n_samples = 16;
    /** By how many roundings of the largest coordinate a point may miss its plane. */
    constexpr double roundings = 16.;

    // In this form the centroid lies exactly in a plane x = const with its face.
    Point<3>
    centroid(const Point<3> &a, const Point<3> &b, const Point<3> &c)
    {
      return a + ((b - a) + (c - a)) / 3.;
    }
  } // namespace

  FaceTest::FaceTest(const TetMesh         &mesh,
                     const scene::Selector &selector,
                     const std::string     &name,
                     const FaceRule         rule)
    : mesh(mesh), rule(rule),
      in_list(mesh.patches.size(), selector.ids.empty() && selector.groups.empty())
  {
    for (unsigned int p = 0; p < mesh.patches.size(); ++p)
      if (std::count(selector.ids.begin(), selector.ids.end(), mesh.patches[p].boundary_id) > 0
          || std::count(selector.groups.begin(), selector.groups.end(), mesh.patches[p].name) > 0)
        in_list[p] = true;
    if (selector.where.empty())
      return;
    condition = std::make_unique<core::Condition>(selector.where, name + "/Where");
    holds_at.assign(mesh.n_points(), unknown);
    const auto [lower, upper] = bounding_box(mesh);
    for (unsigned int d = 0; d < 3; ++d)
      {
        extent   = std::max(extent, upper[d] - lower[d]);
        rounding = std::max({rounding, std::abs(lower[d]), std::abs(upper[d])});
      }
    rounding *= roundings * std::numeric_limits<double>::epsilon();
  }

  bool
  FaceTest::selects(const BoundaryFace &face)
  {
    if (!in_list[face.patch])
      return false;
    if (!condition)
      return true;
    const auto &v = face.vertices;
    if (rule == FaceRule::interior)
      return holds_inside(centroid(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]));
    return std::all_of(v.begin(), v.end(), [&](const auto p) { return holds_at_corner(p); })
           && condition->holds(centroid(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]));
  }

  bool
  FaceTest::is_straddled(const BoundaryFace &face)
  {
    if (rule == FaceRule::interior || !in_list[face.patch] || !condition)
      return false;
    const auto &leaves = condition->leaves();
    return std::any_of(leaves.begin(), leaves.end(), [&](const core::ConditionLeaf &leaf) {
      return may_cross(leaf, face);
    });
  }

  double
  FaceTest::share(const BoundaryFace &face) const
  {
    const Point<3>    &a = mesh.points[face.vertices[0]];
    const Tensor<1, 3> u = (mesh.points[face.vertices[1]] - a) / n_samples;
    const Tensor<1, 3> v = (mesh.points[face.vertices[2]] - a) / n_samples;
    unsigned int       n = 0;
    for (unsigned int i = 0; i < n_samples; ++i)
      for (unsigned int j = 0; i + j < n_samples; ++j)
        {
          const Point<3> corner = a + double(i) * u + double(j) * v;
          n += condition->holds(corner + (u + v) / 3.) ? 1 : 0;
          if (i + j + 1 < n_samples)
            n += condition->holds(corner + 2. / 3. * (u + v)) ? 1 : 0;
        }
    return double(n) / (n_samples * n_samples);
  }

  bool
  FaceTest::holds_at_corner(const unsigned int point)
  {
    if (holds_at[point] == unknown)
      holds_at[point] = condition->holds(mesh.points[point]) ? yes : no;
    return holds_at[point] == yes;
  }

  bool
  FaceTest::holds_inside(const Point<3> &centroid) const
  {
    std::vector<bool> holds;
    bool              at_border = false;
    for (const core::ConditionLeaf &leaf : condition->leaves())
      {
        const double level    = leaf.level(centroid);
        const bool   in_plane = leaf.kind == Kind::affine && std::abs(level) <= rounding;
        at_border             = at_border || in_plane;
        holds.push_back(in_plane ? leaf.includes_border : level < 0.);
      }
    return at_border ? condition->combine(holds) : condition->holds(centroid);
  }

  bool
  FaceTest::may_cross(const core::ConditionLeaf &leaf, const BoundaryFace &face) const
  {
    if (leaf.kind == Kind::constant)
      return false;
    const double          near = leaf.kind == Kind::general ? 0. : same_point * extent;
    std::array<double, 3> level{};
    double                longest = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const Point<3> &p = mesh.points[face.vertices[i]];
        level[i]          = leaf.level(p);
        longest           = std::max(longest, p.distance(mesh.points[face.vertices[(i + 1) % 3]]));
      }
    const auto [least, most] = std::minmax_element(level.begin(), level.end());
    if (*least<-near && * most> near)
      return true;
    switch (leaf.kind)
      {
      case Kind::affine:
        return false;
      case Kind::sphere:
      case Kind::cylinder:
        return std::abs(level[0]) <= longest;
      default:
        return longest > scan_distance * extent;
      }
  }
} // namespace tetradapt::mesh
