// SPDX-License-Identifier: AGPL-3.0-or-later
// Selections split patches, survive refinement, and say what is wrong with them.

#include "tetradapt/mesh/selection.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/mesh_totals.h"
#include "tetradapt/mesh/red_refinement.h"

#include <iostream>

using namespace tetradapt;
using namespace tetradapt::mesh;

scene::Selector
selector(const std::vector<int>         &ids,
         const std::vector<std::string> &groups,
         const std::string              &where)
{
  scene::Selector result;
  result.ids    = ids;
  result.groups = groups;
  result.where  = where;
  return result;
}

void
print_patches(const TetMesh &mesh)
{
  for (const auto &entry : mesh_totals(mesh).patches)
    std::cout << "  " << describe(entry.patch) << ": " << entry.n_faces << " faces, area "
              << entry.area << std::endl;
}

void
expect_error(const scene::Selector &bad)
{
  TetMesh mesh = bricks({0., 0., 0.}, {4., 1., 1.}, {{4, 2, 2}});
  try
    {
      select_faces(mesh, {{"grip", bad}});
      std::cout << "NOT REFUSED" << std::endl;
    }
  catch (const core::InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}

int
main()
{
  TetMesh mesh = bricks({0., 0., 0.}, {4., 1., 1.}, {{4, 2, 2}});

  // The clamp: 1 x 1. Half of the top: 2. By id: two sides of 4. The rim, z near 0 and
  // x below 1, runs over four patches: bottom 1, sides 2 x 0.5, end 0.5. The last
  // selector's expression holds at all corners of the face but not at its centre
  // on the bricks' faces at x = 4, so only y-max is left of its two groups.
  const auto found
    = select_faces(mesh,
                   {{"clamp", selector({}, {"x-min"}, "")},
                    {"load", selector({6}, {}, "x > 1.99")},
                    {"sides", selector({3, 4}, {}, "")},
                    {"rim", selector({}, {}, "x < 1.01 && z < 0.51")},
                    {"hollow",
                     selector({}, {"x-max", "y-max"}, "x < 4 || abs(2*y-rint(2*y)) < 1e-9")}});
  for (const auto &selection : found)
    std::cout << selection.name << ": " << selection.n_faces << " faces, area " << selection.area
              << std::endl;
  print_patches(mesh);

  std::cout << "refined:" << std::endl;
  const TetMesh fine = red_refine(mesh);
  print_patches(fine);
  std::cout << "nothing is lost: "
            << compare_totals(mesh_totals(mesh), mesh_totals(fine), 1e-12).empty() << std::endl;

  // A second call goes on from there.
  const auto again = select_faces(mesh, {{"end", selector({2}, {}, "y < 0.51")}});
  std::cout << again[0].area << ", patches " << mesh.patches.size() << ", "
            << describe(mesh.patches[mesh.faces.back().patch]) << std::endl;

  expect_error(selector({}, {}, "x < -0.5"));
  expect_error(selector({1, 6}, {"x-max"}, "x > 1 && x < 2.5"));
  expect_error(selector({1, 17}, {}, ""));
  expect_error(selector({}, {"x-mni"}, ""));
  expect_error(selector({}, {}, "x <"));
}
