// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexahedral_selection.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/blocks.h"
#include "tetradapt/mesh/face_selectors.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tetradapt::solve
{
  using namespace hexahedral;

  namespace
  {
    constexpr double most_bricks = 300.; ///< about, where the shape allows it

    double
    selected_area(const mesh::TetMesh &mesh, const std::string &name)
    {
      double sum = 0.;
      for (const auto &face : mesh.faces)
        {
          const auto &selections = mesh.patches[face.patch].selections;
          if (std::find(selections.begin(), selections.end(), name) != selections.end())
            sum += mesh::face_area_vector(mesh, face).norm();
        }
      return sum;
    }

    /** The first grid: the planes of the blocks, or of the box. */
    HexahedralGrid
    block_grid(const scene::MeshParameters &parameters)
    {
      HexahedralGrid grid;
      if (parameters.source != scene::MeshSource::blocks)
        {
          for (unsigned int d = 0; d < 3; ++d)
            grid.planes[d] = {parameters.lower_corner[d], parameters.upper_corner[d]};
          grid.filled  = {true};
          grid.regions = {0};
          return grid;
        }
      const mesh::BlockGrid blocks(parameters.blocks);
      grid.planes = blocks.coordinates;
      for (int k = 0; k < blocks.size(2); ++k)
        for (int j = 0; j < blocks.size(1); ++j)
          for (int i = 0; i < blocks.size(0); ++i)
            {
              const unsigned int block = blocks.block(i, j, k);
              grid.filled.push_back(block != mesh::BlockGrid::outside);
              grid.regions.push_back(grid.filled.back() && !parameters.block_regions.empty()
                                       ? parameters.block_regions[block]
                                       : 0);
            }
      return grid;
    }

    /** The planes, and others between them at distances of about @p h. */
    std::array<std::vector<double>, 3>
    divided_planes(const HexahedralGrid &grid, const double h)
    {
      std::array<std::vector<double>, 3> planes;
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int i = 0; i + 1 < grid.planes[d].size(); ++i)
          {
            const double       from = grid.planes[d][i], to = grid.planes[d][i + 1];
            const unsigned int n = std::max(1l, std::lround((to - from) / h));
            for (unsigned int k = i == 0 ? 0 : 1; k <= n; ++k)
              planes[d].push_back(k == 0 ? from : k == n ? to : (from * (n - k) + to * k) / n);
          }
      return planes;
    }

    /** Cuts intervals so that bricks are about cubic, and not too many. */
    HexahedralGrid
    subdivided(const HexahedralGrid &grid)
    {
      double shortest = extent(grid), volume = 0.;
      for (const auto &along : grid.planes)
        for (unsigned int i = 1; i < along.size(); ++i)
          shortest = std::min(shortest, along[i] - along[i - 1]);
      for (unsigned int brick = 0; brick < grid.n_bricks(); ++brick)
        if (grid.filled[brick])
          {
            const auto size = grid.corner(brick, 7) - grid.corner(brick, 0);
            volume += size[0] * size[1] * size[2];
          }
      // Flat bodies would have more bricks than cubes of that volume tell: then larger ones.
      for (double h = std::max(shortest, std::cbrt(volume / most_bricks));; h *= 1.25)
        {
          const auto   planes = divided_planes(grid, h);
          const double bricks
            = (planes[0].size() - 1.) * (planes[1].size() - 1.) * (planes[2].size() - 1.);
          const bool coarsest = planes == grid.planes;
          if (bricks <= 4. * most_bricks || coarsest || h > extent(grid))
            return with_planes(grid, planes);
        }
    }
  } // namespace

  HexahedralGrid
  make_hexahedral_grid(const scene::Scene &scene, const mesh::TetMesh &mesh, const core::Log &log)
  {
    for (const auto &load : scene.loads)
      if (load.type == scene::LoadType::nodal_force)
        throw core::InputError(
          "Loads/" + load.name
          + "/Type: forces on nodes depend on the mesh, so a hexahedral reference cannot have "
            "them. Use traction, or Reference/Type = fine mesh.");
    // A selection is decided on the coarsest grid that serves it, and inherited: what
    // holds at the corners of a small rectangle need not hold at those of a large one.
    const HexahedralGrid        blocks = block_grid(scene.mesh);
    std::vector<Selection>      selections;
    std::vector<HexahedralGrid> grids;
    auto                        planes = blocks.planes;
    for (const auto &[name, selector] : mesh::face_selectors(scene))
      {
        selections.emplace_back(name, selector);
        grids.push_back(resolved(blocks, selections.back(), selected_area(mesh, name), log));
        merge_planes(planes, grids.back().planes, extent(blocks));
      }
    HexahedralGrid grid = subdivided(with_planes(blocks, planes));

    grid.sides.resize(grid.n_bricks());
    for (auto &sides : grid.sides)
      sides.fill(HexahedralGrid::none);
    std::map<std::pair<unsigned int, std::vector<bool>>, unsigned int> numbers;
    for (const auto &r : boundary(grid))
      {
        std::vector<bool> selected;
        for (unsigned int s = 0; s < selections.size(); ++s)
          selected.push_back(selections[s].selects(
            rectangle(grids[s], brick_around(grids[s], grid, r.brick), r.side)));
        const auto [entry, is_new]
          = numbers.emplace(std::make_pair(r.side, selected), numbers.size());
        grid.sides[r.brick][r.side] = entry->second;
        if (!is_new)
          continue;
        grid.patches.push_back(mesh::box_patches()[r.side]);
        for (unsigned int s = 0; s < selections.size(); ++s)
          if (selected[s])
            grid.patches.back().selections.push_back(selections[s].name());
      }
    return grid;
  }
} // namespace tetradapt::solve
