// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_grid_h
#define tetradapt_solve_hexahedral_grid_h

#include "tetradapt/core/log.h"
#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::solve
{
  using dealii::Point;

  /**
   * The coarsest hexahedra of a body made of boxes: the bricks of a tensor grid, about
   * cubic, with their regions and with what is selected on their outer sides.
   */
  struct HexahedralGrid
  {
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    std::array<std::vector<double>, 3> planes; ///< along each axis, increasing
    std::vector<bool>                  filled; ///< one a brick, along x first
    std::vector<int>                   regions;
    /** Patch of each outer side (x-min, x-max, y-min, ...) of a brick; none for others. */
    std::vector<std::array<unsigned int, 6>> sides;
    std::vector<mesh::Patch>                 patches;

    unsigned int
    size(unsigned int d) const
    {
      return planes[d].size() - 1;
    }
    unsigned int
    n_bricks() const
    {
      return filled.size();
    }
    /** Number of a brick along the axes. */
    std::array<unsigned int, 3>
    position(unsigned int brick) const
    {
      return {{brick % size(0), brick / size(0) % size(1), brick / size(0) / size(1)}};
    }
    Point<3>
    corner(unsigned int brick, unsigned int number) const
    {
      const auto i = position(brick);
      return {planes[0][i[0] + (number & 1)],
              planes[1][i[1] + (number >> 1 & 1)],
              planes[2][i[2] + (number >> 2)]};
    }
  };

  /**
   * The grid of a scene whose mesh is a box, bricks or blocks. A side is selected by
   * the rule for triangles: listed, and the expression holds at its corners and its
   * centre. Where that does not give the area that the supports and loads have on
   * @p mesh, planes are added where expressions change along an axis.
   *
   * @param mesh the scene's first mesh with its selections: the same problem is to be
   *        solved on both. A warning says where they select different areas.
   * @throws core::InputError if the border of a selection follows no planes parallel
   *         to the axes, or a load acts on nodes.
   */
  HexahedralGrid
  make_hexahedral_grid(const scene::Scene &scene, const mesh::TetMesh &mesh, const core::Log &log);
} // namespace tetradapt::solve

#endif
