// SPDX-License-Identifier: AGPL-3.0-or-later
// What VtuSeries writes is read back: bit by bit what must be, to single precision
// what is for looking at. Also the description of a mesh for the log.

#include "tetradapt/report/vtu_series.h"
#include "tetradapt/adapt/mesh_record.h"

#include "tetradapt/io/vtu_file.h"
#include "tetradapt/io/vtu_reader.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/report/mean_stresses.h"
#include "tetradapt/report/mesh_summary.h"
#include "tetradapt/report/record_columns.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace tetradapt;
namespace fs = std::filesystem;

const std::string folder = "vtu_series_scratch";

/** Two bricks along x, each a region. */
std::shared_ptr<mesh::TetMesh>
make_mesh()
{
  auto m = std::make_shared<mesh::TetMesh>(
    mesh::bricks(mesh::Point<3>(0., 0., 0.), mesh::Point<3>(2., 1., 1.), {{2, 1, 1}}));
  for (unsigned int cell = 6; cell < 12; ++cell)
    m->regions[cell] = 7;
  m->region_names[7]       = "bone & <marrow>";
  m->patches[0].selections = {"clamp"};
  return m;
}

bool
close(const std::vector<double> &read, const std::vector<double> &written)
{
  if (read.size() != written.size() || read.empty())
    return false;
  for (unsigned int i = 0; i < read.size(); ++i)
    if (std::abs(read[i] - written[i]) > 6.1e-8 * std::abs(written[i]) + 1e-37)
      return false;
  return true;
}

std::vector<double>
numbers(const io::VtuFile &file, const std::string &section, const std::string &name)
{
  return file.numbers(file.array(section, name));
}

void
print_names(const io::VtuFile &file)
{
  for (const std::string section : {"PointData", "CellData", "FieldData"})
    {
      std::cout << "  " << section << ':';
      for (const std::string &name : file.names(section))
        std::cout << ' ' << name;
      std::cout << std::endl;
    }
}

void
test_run(const unsigned int degree, const bool full)
{
  const auto   m = make_mesh();
  scene::Scene scene;
  scene.name = "beam";
  scene.materials.resize(1);
  const mechanics::MaterialMap materials(scene, *m);
  mesh::NodalField             u(m, degree);
  for (unsigned int n = 0; n < u.n_nodes(); ++n)
    for (unsigned int d = 0; d < 3; ++d)
      u.values[n][d] = std::sin(1. + 3. * n + d) / 3.;
  u.values[1] = mesh::Tensor<1, 3>({-0., 1e-310, 1e300});

  std::vector<double> indicators(m->n_cells()), ren(u.n_nodes());
  for (unsigned int i = 0; i < indicators.size(); ++i)
    indicators[i] = std::exp(-1. * i);
  for (unsigned int i = 0; i < ren.size(); ++i)
    ren[i] = 1. / (1. + i);
  u.values[1][2] = 1. / 7.;

  adapt::CycleRecord record;
  record.strain_energy = M_PI;
  if (full)
    record.relative_energy_error = 1. / 3.;

  report::ResultFolder results(folder);
  report::VtuSeries    series(results, full);
  series.run_started(scene);
  for (record.cycle = 0; record.cycle < 2; ++record.cycle)
    series.cycle_done(
      {record, u.mesh(), &u, materials, full ? &indicators : nullptr, full ? &ren : nullptr});

  std::cout << "degree " << degree << (full ? ", all data" : ", displacement only") << std::endl;
  const std::string path = folder + "/cycle_001.vtu";
  const io::VtuFile file(path);
  print_names(file);

  const io::DisplacementFile             read   = io::read_displacement_vtu(path);
  const mesh::TetMesh                   &back   = read.displacement->mesh();
  const std::vector<mesh::Tensor<1, 3>> &values = read.displacement->values;
  std::cout << "  degree " << read.displacement->degree() << ", bits equal: "
            << (values.size() == u.values.size()
                && std::memcmp(values.data(), u.values.data(), values.size() * sizeof values[0])
                     == 0)
            << ", cells equal: " << (back.cells == m->cells)
            << ", regions equal: " << (back.regions == m->regions) << ", named '"
            << (back.region_names.count(7) ? back.region_names.at(7) : "") << "', faces "
            << back.faces.size() << ", patches " << back.patches.size() << " '"
            << back.patches.at(0).name << "'" << std::endl;
  std::cout << "  scene '" << read.texts.at("scene") << "', cycle " << read.values.at("cycle")
            << ", strain_energy equal: " << (read.values.at("strain_energy") == M_PI)
            << ", relative_energy_error: "
            << (full ? read.values.at("relative_energy_error") == 1. / 3.
                     : read.values.count("relative_energy_error"))
            << std::endl;
  if (full)
    {
      const report::MeanStresses stress = report::mean_stresses(u, materials);
      std::cout << "  stress " << close(numbers(file, "CellData", "stress"), stress.stress) << ' '
                << io::VtuFile::n_components(file.array("CellData", "stress")) << ", von Mises "
                << close(numbers(file, "CellData", "von_mises"), stress.von_mises) << ", indicator "
                << close(numbers(file, "CellData", "error_indicator"), indicators) << ", REN "
                << close(numbers(file, "PointData", "REN"), ren) << std::endl;
    }
}

int
main()
{
  fs::remove_all(folder);
  fs::create_directory(folder);
  test_run(1, true);
  test_run(2, true);
  test_run(2, false);

  std::ifstream      in(folder + "/beam.pvd");
  std::ostringstream pvd;
  pvd << in.rdbuf();
  std::cout << pvd.str();
  std::cout << "files: " << std::distance(fs::directory_iterator(folder), fs::directory_iterator())
            << std::endl;
  fs::remove_all(folder);

  // The patch of each cell, compared with what the corners' positions say: the
  // boundary ids of the box are its sides in order.
  const auto m = make_mesh();
  std::cout << "surface patches:";
  for (const int patch : report::surface_patches(*m))
    std::cout << ' ' << patch;
  std::cout << std::endl;
  bool                   right   = true;
  const std::vector<int> patches = report::surface_patches(*m);
  for (unsigned int cell = 0; cell < m->n_cells(); ++cell)
    {
      int largest = -1;
      for (int side = 0; side < 6; ++side)
        {
          unsigned int n_on_side = 0;
          for (const unsigned int v : m->cells[cell])
            {
              const double bound = side % 2 == 0 ? 0. : (side == 1 ? 2. : 1.);
              n_on_side += m->points[v][side / 2] == bound;
            }
          if (n_on_side == 3)
            largest = side;
        }
      right = right && patches[cell] == largest;
    }
  std::cout << "as by geometry: " << right << std::endl;

  adapt::MeshRecord record;
  adapt::describe_mesh(*m, 1., record);
  std::cout << report::mesh_line(*m, record) << std::endl << report::mesh_summary(*m) << std::endl;
}
