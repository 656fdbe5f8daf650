// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The surface of a scene with what acts on it, read back, and the tables beside it.

#include "tetradapt/report/preview.h"

#include "tetradapt/io/vtu_file.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/face_selectors.h"
#include "tetradapt/mesh/selection.h"

#include <cmath>
#include <iostream>

using namespace tetradapt;

namespace
{
  scene::Scene
  make_scene()
  {
    scene::Scene scene;
    scene.materials.resize(2);
    scene.materials[0].name    = "bone";
    scene.materials[0].regions = {3};
    scene.materials[1].name    = "fat";
    scene.supports.resize(2);
    scene.supports[0].name            = "foot";
    scene.supports[0].selector.groups = {"z-min"};
    scene.supports[1].name            = "side";
    scene.supports[1].components      = {{true, false, false}};
    scene.supports[1].selector.where  = "x < 1e-9 && z > 1 - 1e-9";
    scene.loads.resize(2);
    scene.loads[0].name           = "patch";
    scene.loads[0].type           = scene::LoadType::pressure;
    scene.loads[0].selector.where = "z > 4-1e-9 && x < 1 + 1e-9";
    scene.loads[1].name           = "weight";
    scene.loads[1].type           = scene::LoadType::body_force;
    scene.loads[1].selector.ids   = {3};
    scene.goals.resize(1);
    scene.goals[0].name           = "lift";
    scene.goals[0].type           = scene::GoalType::mean_displacement;
    scene.goals[0].selector.where = "everywhere";
    return scene;
  }

  /** The area of the triangles where the array @p name of @p file is @p value, by their
   * corners. */
  double
  area_where(const io::VtuFile &file, const std::string &name, const int value)
  {
    const auto points  = file.numbers(file.coordinates());
    const auto corners = file.integers(file.array("Cells", "connectivity"));
    const auto values  = file.integers(file.array("CellData", name), file.n_cells());
    double     area    = 0.;
    for (std::size_t i = 0; i < file.n_cells(); ++i)
      if (values[i] == value)
        {
          dealii::Point<3> p[3];
          for (unsigned int v = 0; v < 3; ++v)
            for (unsigned int d = 0; d < 3; ++d)
              p[v][d] = points[3 * corners[3 * i + v] + d];
          area += 0.5 * dealii::cross_product_3d(p[1] - p[0], p[2] - p[0]).norm();
        }
    return area;
  }

  double
  sum(const std::vector<double> &values)
  {
    double result = 0.;
    for (const double value : values)
      result += value;
    return result;
  }
} // namespace

int
main()
{
  const scene::Scene scene = make_scene();
  // 2 x 3 x 4, with region 3 where z < 1.
  mesh::TetMesh body = mesh::bricks({0., 0., 0.}, {2., 3., 4.}, {{2, 3, 4}});
  for (unsigned int cell = 0; cell < body.n_cells(); ++cell)
    {
      double z = 0.;
      for (const unsigned int v : body.cells[cell])
        z += 0.25 * body.points[v][2];
      body.regions[cell] = z < 1. ? 3 : 0;
    }
  body.region_names = {{3, "hard"}};
  mesh::select_faces(body, mesh::face_selectors(scene));

  std::cout << report::preview_tables(scene, body);
  report::write_preview("preview.vtu", scene, body);
  const io::VtuFile file("preview.vtu");
  std::cout << file.n_points() << " points of " << body.n_points() << ", " << file.n_cells()
            << " triangles\n";
  for (const std::string name :
       {"Supports/foot", "Supports/side", "Loads/patch", "Loads/weight", "Goals/lift"})
    std::cout << name << ": area " << area_where(file, name, 1) << ", elsewhere "
              << area_where(file, name, 0) << '\n';
  std::cout << "region 3: " << area_where(file, "region", 3)
            << ", fat: " << area_where(file, "material", 1)
            << ", z-max: " << area_where(file, "boundary_id", 6)
            << ", all of it: " << sum(file.numbers(file.array("CellData", "area"), file.n_cells()))
            << '\n';
  for (const std::string name : {"boundary_names", "region_names", "material_names"})
    std::cout << name << ":\n" << file.text(file.array("FieldData", name));
}
