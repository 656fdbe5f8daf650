// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/bricks.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/finalize.h"

#include <cmath>
#include <limits>

namespace tetradapt::mesh
{
  namespace
  {
    /** The order in which a path from a brick's lower to its upper corner takes
     * the three directions; each path is one tetrahedron. */
    constexpr std::array<std::array<unsigned int, 3>, 6> paths{
      {{{0, 1, 2}}, {{1, 2, 0}}, {{2, 0, 1}}, {{0, 2, 1}}, {{1, 0, 2}}, {{2, 1, 0}}}};

    /** Paths from this one on are odd permutations: negative tetrahedra. */
    constexpr unsigned int first_odd_path = 3;



    void
    check_counts(const std::array<unsigned int, 3> &n)
    {
      const std::string text
        = std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]);
      if (n[0] == 0 || n[1] == 0 || n[2] == 0)
        throw core::InputError(
          "A box of " + text + " bricks is asked for: there must be at least one along each axis.");
      const double       n_points = (n[0] + 1.) * (n[1] + 1.) * (n[2] + 1.);
      const double       n_cells  = 6. * n[0] * n[1] * n[2];
      const unsigned int limit    = std::numeric_limits<unsigned int>::max() / 8;
      if (n_points > limit || n_cells > limit)
        throw core::InputError(
          "A box of " + text + " bricks has more than the " + std::to_string(limit)
          + " points or tetrahedra that can be numbered. Ask for fewer bricks.");
    }



    /** The coordinates of the planes between bricks along axis @p d. */
    std::vector<double>
    planes(const Point<3> &lower, const Point<3> &upper, const unsigned int d, const unsigned int n)
    {
      if (!std::isfinite(lower[d]) || !std::isfinite(upper[d]) || !(lower[d] < upper[d]))
        throw core::InputError(
          "The box from " + to_string(lower) + " to " + to_string(upper) + " has no extent along "
          + "xyz"[d]
          + ". Each coordinate of the upper corner must be larger than the lower one's.");
      std::vector<double> x(n + 1);
      for (unsigned int i = 0; i <= n; ++i)
        {
          // This form is exact at both ends and symmetric.
          x[i] = (lower[d] * (n - i) + upper[d] * i) / n;
          // Far from the origin rounding would make bricks of different sizes.
          const double rounding = std::numeric_limits<double>::epsilon() * std::abs(x[i]);
          if (!std::isfinite(x[i]) || (i > 0 && !(x[i] - x[i - 1] > 1e4 * rounding)))
            throw core::InputError(
              "The box from " + to_string(lower) + " to " + to_string(upper)
              + " cannot be cut into " + std::to_string(n) + " bricks along " + "xyz"[d]
              + ": their coordinates, which are rounded, cannot be told apart. "
                "Move the box to the origin, or ask for fewer bricks.");
        }
      x[0] = lower[d];
      x[n] = upper[d];
      return x;
    }



    /** The two triangles of every brick's face on one side of the box. */
    void
    add_side(TetMesh                           &mesh,
             const std::array<unsigned int, 3> &n,
             const std::array<unsigned int, 3> &stride,
             const unsigned int                 axis,
             const bool                         upper)
    {
      const unsigned int patch = 2 * axis + upper;
      const unsigned int a     = (axis + 1) % 3;
      const unsigned int b     = (axis + 2) % 3;
      const unsigned int start = upper ? n[axis] * stride[axis] : 0;
      for (unsigned int j = 0; j < n[b]; ++j)
        for (unsigned int i = 0; i < n[a]; ++i)
          {
            const unsigned int p = start + i * stride[a] + j * stride[b];
            const unsigned int q = p + stride[a], r = p + stride[b], s = q + stride[b];
            // Every cut of a face goes from its lower to its upper corner;
            // (a, b, axis) is a right-handed system.
            mesh.faces.push_back({{{p, upper ? q : s, upper ? s : q}}, patch});
            mesh.faces.push_back({{{p, upper ? s : r, upper ? r : s}}, patch});
          }
    }
  } // namespace



  TetMesh
  bricks(const Point<3> &lower, const Point<3> &upper, const std::array<unsigned int, 3> &n)
  {
    check_counts(n);
    const std::array<std::vector<double>, 3> x{{planes(lower, upper, 0, n[0]),
                                                planes(lower, upper, 1, n[1]),
                                                planes(lower, upper, 2, n[2])}};
    const std::array<unsigned int, 3>        stride{{1, n[0] + 1, (n[0] + 1) * (n[1] + 1)}};

    TetMesh mesh;
    mesh.points.reserve((n[0] + 1) * (n[1] + 1) * (n[2] + 1));
    for (const double z : x[2])
      for (const double y : x[1])
        for (const double x : x[0])
          mesh.points.emplace_back(x, y, z);

    mesh.cells.reserve(6 * n[0] * n[1] * n[2]);
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          for (unsigned int path = 0; path < paths.size(); ++path)
            {
              std::array<unsigned int, 4> cell;
              cell[0] = i * stride[0] + j * stride[1] + k * stride[2];
              for (unsigned int step = 0; step < 3; ++step)
                cell[step + 1] = cell[step] + stride[paths[path][step]];
              if (path >= first_odd_path)
                std::swap(cell[2], cell[3]);
              mesh.cells.push_back(cell);
            }
    mesh.regions.assign(mesh.cells.size(), 0);

    for (unsigned int axis = 0; axis < 3; ++axis)
      for (const bool upper_side : {false, true})
        {
          Patch patch;
          patch.boundary_id = 2 * axis + upper_side + 1;
          patch.name        = std::string(1, "xyz"[axis]) + (upper_side ? "-max" : "-min");
          mesh.patches.push_back(patch);
          add_side(mesh, n, stride, axis, upper_side);
        }
    return mesh;
  }
} // namespace tetradapt::mesh
