// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Meshes of several parts: what fills space twice or is not joined is named, what only
// touches in shared points is taken.

#include "tetradapt/mesh/embedding.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/finalize.h"

#include <cmath>
#include <iostream>

using namespace tetradapt;
using dealii::Point;

namespace
{
  using Cells = std::array<unsigned int, 3>;

  mesh::TetMesh
  block(const Point<3> &lower, const Point<3> &upper, const Cells &cells)
  {
    return mesh::bricks(lower, upper, cells);
  }

  /** Both in one mesh; points at the same place become one if @p merge. */
  mesh::TetMesh
  together(mesh::TetMesh a, const mesh::TetMesh &b, const bool merge = true)
  {
    std::vector<unsigned int> number;
    for (const auto &p : b.points)
      {
        unsigned int same = 0;
        while (same < a.n_points() && (!merge || a.points[same].distance(p) > 1e-12))
          ++same;
        if (same == a.n_points())
          a.points.push_back(p);
        number.push_back(same);
      }
    for (auto cell : b.cells)
      {
        for (unsigned int &v : cell)
          v = number[v];
        a.cells.push_back(cell);
      }
    a.faces.clear();
    a.patches.clear();
    a.regions.clear();
    return a;
  }

  /** Turned about the z axis, so that nothing is exact any more. */
  mesh::TetMesh
  turned(mesh::TetMesh body)
  {
    for (auto &p : body.points)
      p = Point<3>(std::cos(.7) * p[0] - std::sin(.7) * p[1],
                   std::sin(.7) * p[0] + std::cos(.7) * p[1],
                   p[2]);
    return body;
  }

  void
  check(const std::string &what, mesh::TetMesh body)
  {
    core::Log log;
    log.add_sink(
      [](core::LogLevel, const std::string &text) { std::cout << "  warning: " << text << '\n'; });
    std::cout << what << '\n';
    try
      {
        mesh::finalize(body, "'m.vtk'");
        mesh::check_embedding(body, "'m.vtk'", log);
        std::cout << "  taken\n";
      }
    catch (const core::InputError &error)
      {
        std::cout << "  " << error.what() << '\n';
      }
  }
} // namespace

int
main()
{
  const Point<3> origin, corner(1, 1, 1);
  const auto     cube = block(origin, corner, {{2, 2, 2}});
  check("one body", cube);
  check("one body, turned", turned(cube));
  check("joined", together(cube, block(Point<3>(1, 0, 0), Point<3>(2, 1, 1), {{1, 2, 2}})));
  check("joined, turned",
        turned(together(cube, block(Point<3>(1, 0, 0), Point<3>(2, 1, 1), {{1, 2, 2}}))));
  check("sharing an edge",
        together(cube, block(Point<3>(1, 1, 0), Point<3>(2, 2, 1), {{1, 1, 2}})));
  check("sharing a point", together(cube, block(corner, Point<3>(2, 2, 2), {{1, 1, 1}})));
  check("apart", together(cube, block(Point<3>(1.5, 0, 0), Point<3>(2, 1, 1), {{1, 2, 2}})));

  check("penetrating",
        together(cube, block(Point<3>(.7, .1, .2), Point<3>(2, .8, .9), {{3, 2, 2}})));
  check("twice, cut differently", together(cube, block(origin, corner, {{3, 3, 3}})));
  check("one inside the other",
        together(cube, block(Point<3>(.3, .3, .3), Point<3>(.4, .45, .4), {{1, 1, 1}})));
  check("interface cut differently",
        together(cube, block(Point<3>(1, 0, 0), Point<3>(2, 1, 1), {{1, 3, 3}})));
  check("interface cut differently, turned",
        turned(together(cube, block(Point<3>(1, 0, 0), Point<3>(2, 1, 1), {{1, 3, 3}}))));
  check("smaller face on a larger one",
        together(cube, block(Point<3>(1, .3, .3), Point<3>(2, .6, .6), {{1, 1, 1}})));
  check("narrow gap",
        together(cube, block(Point<3>(1 + 1e-5, 0, 0), Point<3>(2, 1, 1), {{1, 2, 2}}), false));
  check("clearance",
        together(cube, block(Point<3>(1.02, 0, 0), Point<3>(2, 1, 1), {{1, 2, 2}}), false));
}
