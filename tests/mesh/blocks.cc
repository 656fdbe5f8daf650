// SPDX-License-Identifier: AGPL-3.0-or-later

// Bodies made of boxes: TetGen's mesh has their volume, the area of every side and
// the volume of every region; boxes may share parts of faces; contact along an edge
// or in a point is refused.

#include "tetradapt/mesh/blocks.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/mesh_totals.h"
#include "tetradapt/mesh/tetgen.h"

#include <iostream>

using namespace tetradapt;
using dealii::Point;
using Boxes = std::vector<std::pair<Point<3>, Point<3>>>;

namespace
{
  void
  print(const std::string &name, const Boxes &boxes, const std::vector<int> &regions = {})
  {
    const mesh::Tetgen tetgen{scene::TetgenParameters()};
    const auto         complex = mesh::blocks_complex(mesh::BlockGrid(boxes), regions);
    const auto         mesh    = tetgen.mesh(complex, {0.01, {}, {}});
    const auto         totals  = mesh::mesh_totals(mesh);
    std::cout << name << ": volume " << totals.volume;
    for (const auto &patch : totals.patches)
      std::cout << ", " << patch.patch.boundary_id << ' ' << patch.patch.name << ' ' << patch.area;
    for (const auto &[id, region] : totals.regions)
      std::cout << ", region " << id << ' ' << region.volume;
    // Finer, so that the regions' border is refined as well.
    mesh::Sizing sizing;
    sizing.node_sizes.assign(mesh.n_points(), 0.1);
    const auto refined = mesh::mesh_totals(tetgen.refine(mesh, sizing));
    std::cout << (mesh::compare_totals(totals, refined, 1e-12).empty() ? ", kept by refinement"
                                                                       : ", LOST")
              << std::endl;
  }

  void
  refuse(const Boxes &boxes)
  {
    try
      {
        const mesh::BlockGrid grid(boxes);
        std::cout << "NOT REFUSED" << std::endl;
      }
    catch (const core::InputError &error)
      {
        std::cout << error.what() << std::endl;
      }
  }
} // namespace

int
main()
{
  const Point<3> origin(0, 0, 0);
  print("L-shape",
        {{Point<3>(-1, -1, 0), Point<3>(0, 0, .5)},
         {Point<3>(-1, 0, 0), Point<3>(0, 1, .5)},
         {Point<3>(0, 0, 0), Point<3>(1, 1, .5)}});
  // A small block amid the face of a large one; a third that is 0.1 + 0.2 away.
  print("on top",
        {{origin, Point<3>(1, 1, .3)}, {Point<3>(.25, .3, .1 + .2), Point<3>(.75, .8, 1)}});
  // An inclusion that reaches the surface, one inside, two parts of one region.
  print("layers",
        {{origin, Point<3>(1, 1, .25)},
         {Point<3>(0, 0, .25), Point<3>(1, .5, .75)},
         {Point<3>(0, .5, .25), Point<3>(1, 1, .75)},
         {Point<3>(0, 0, .75), Point<3>(1, 1, 1)}},
        {7, -3, 4, 7});
  print("inclusion",
        {{origin, Point<3>(1, 1, .25)},
         {Point<3>(0, 0, .75), Point<3>(1, 1, 1)},
         {Point<3>(0, 0, .25), Point<3>(1, .25, .75)},
         {Point<3>(0, .75, .25), Point<3>(1, 1, .75)},
         {Point<3>(0, .25, .25), Point<3>(.25, .75, .75)},
         {Point<3>(.75, .25, .25), Point<3>(1, .75, .75)},
         {Point<3>(.25, .25, .25), Point<3>(.75, .75, .75)}},
        {0, 0, 0, 0, 0, 0, 1});
  print("apart", {{origin, Point<3>(1, 1, 1)}, {Point<3>(2, 0, 0), Point<3>(3, 1, .5)}}, {5, 5});

  refuse({});
  refuse({{origin, Point<3>(1, 1, 1)}, {Point<3>(1, 1, 0), Point<3>(2, 2, 1)}});
  refuse({{origin, Point<3>(1, 1, 1)}, {Point<3>(1, 1, 1), Point<3>(2, 2, 2)}});
  refuse({{origin, Point<3>(1, 1, 1)}, {Point<3>(0, .5, 0), Point<3>(1, 2, 1)}});
  refuse({{origin, Point<3>(1, 1, 1)}, {Point<3>(1, 1e-5, 0), Point<3>(2, 1, 1)}});
}
