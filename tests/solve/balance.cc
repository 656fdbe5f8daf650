// SPDX-License-Identifier: AGPL-3.0-or-later
//
// In every scene that comes with the program reactions and loads balance, and the resultants of
// loads are those of another quadrature, on the scene's first mesh.

#include "tetradapt/core/expression.h"
#include "tetradapt/core/expression_tokens.h"
#include "tetradapt/io/mesh_source.h"
#include "tetradapt/scene/scene_reader.h"
#include "tetradapt/solve/static_solution.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>

using namespace tetradapt;
using dealii::Point;
using dealii::Tensor;
using mechanics::Resultant;
namespace fs = std::filesystem;

namespace
{
  constexpr unsigned int most_cells = 6000;

  /** A load's resultant, and the sum of the lengths of what it adds up. */
  struct Integral
  {
    Resultant resultant;
    double    size = 0.;

    void
    add(const Point<3> &x, const Tensor<1, 3> &force)
    {
      resultant.add(x, force);
      size += force.norm();
    }
  };

  bool
  carries(const mesh::TetMesh &mesh, const mesh::BoundaryFace &face, const std::string &load)
  {
    const auto &names = mesh.patches[face.patch].selections;
    return std::find(names.begin(), names.end(), "Loads/" + load) != names.end();
  }

  /** With n^2 triangles a face, and 7 points in each. */
  Integral
  on_faces(const scene::LoadParameters &load, const mesh::TetMesh &mesh)
  {
    const bool                   pressure = load.type == scene::LoadType::pressure;
    const core::VectorExpression value(
      pressure ? std::array<std::string, 3>{{load.value[0], "0", "0"}} : load.value, "load");
    const dealii::QGaussSimplex<2> rule(3);
    constexpr unsigned int         n = 12;
    Integral                       sum;
    for (const auto &face : mesh.faces)
      {
        if (!carries(mesh, face, load.name))
          continue;
        const Tensor<1, 3> area = mesh::face_area_vector(mesh, face);
        const Point<3>    &a    = mesh.points[face.vertices[0]];
        const Tensor<1, 3> u    = mesh.points[face.vertices[1]] - a,
                           v    = mesh.points[face.vertices[2]] - a;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; i + j < n; ++j)
            for (unsigned int turned = 0; turned < (i + j + 1 < n ? 2u : 1u); ++turned)
              for (unsigned int q = 0; q < rule.size(); ++q)
                {
                  const double   s = turned == 1 ? i + 1. - rule.point(q)[0] : i + rule.point(q)[0];
                  const double   t = turned == 1 ? j + 1. - rule.point(q)[1] : j + rule.point(q)[1];
                  const Point<3> x = a + (s * u + t * v) / double(n);
                  const Tensor<1, 3> given  = value(x);
                  const double       weight = 2. * rule.weight(q) / (n * n);
                  sum.add(x, weight * (pressure ? -given[0] * area : area.norm() * given));
                }
      }
    return sum;
  }

  Integral
  on_points(const scene::LoadParameters &load, const mesh::TetMesh &mesh)
  {
    const core::VectorExpression value(load.value, "load");
    std::set<unsigned int>       points;
    for (const auto &face : mesh.faces)
      if (carries(mesh, face, load.name))
        points.insert(face.vertices.begin(), face.vertices.end());
    Integral sum;
    for (const unsigned int p : points)
      sum.add(mesh.points[p], value(mesh.points[p]));
    return sum;
  }

  /** With a product rule of 125 points a cell. */
  Integral
  in_cells(const scene::LoadParameters  &load,
           const mesh::TetMesh          &mesh,
           const mechanics::MaterialMap &materials)
  {
    const core::VectorExpression expression(load.value, "load");
    const bool                   turns = load.type == scene::LoadType::rotation;
    const auto                   value = [&](const Point<3> &x) {
      if (!turns)
        return expression(x);
      const Tensor<1, 3> e = *load.rotation.axis / load.rotation.axis->norm();
      const Tensor<1, 3> r = x - load.rotation.axis_point;
      return load.rotation.angular_velocity * load.rotation.angular_velocity * (r - (r * e) * e);
    };
    const auto regions
      = mechanics::resolve_regions(load.selector.ids, load.selector.groups, mesh, "load");
    const dealii::QGauss<1> rule(5);
    Integral                sum;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const int region = mesh.regions[cell];
        if (regions.count(region) == 0)
          continue;
        const double density = turns || load.type == scene::LoadType::gravity
                                 ? materials.parameters(region).density
                                 : 1.;
        const double volume  = mesh::cell_volume(mesh, cell);
        // The unit cube is folded into the tetrahedron.
        for (unsigned int i = 0; i < 5; ++i)
          for (unsigned int j = 0; j < 5; ++j)
            for (unsigned int k = 0; k < 5; ++k)
              {
                const double r = rule.point(i)[0], s = rule.point(j)[0] * (1. - r),
                             t      = rule.point(k)[0] * (1. - r - s);
                const double weight = 6. * rule.weight(i) * rule.weight(j) * rule.weight(k)
                                      * (1. - r) * (1. - r - s) * volume * density;
                const auto    &c = mesh.cells[cell];
                const Point<3> x(r * mesh.points[c[1]] + s * Tensor<1, 3>(mesh.points[c[2]])
                                 + t * Tensor<1, 3>(mesh.points[c[3]])
                                 + (1. - r - s - t) * Tensor<1, 3>(mesh.points[c[0]]));
                sum.add(x, weight * value(x));
              }
      }
    return sum;
  }

  /** What the scene says; not the moment about a point that it does not give. */
  Integral
  as_given(const scene::LoadParameters &load, const Resultant &computed)
  {
    Integral sum;
    sum.resultant       = computed;
    sum.resultant.force = core::VectorExpression(load.value, "load")(Point<3>());
    if (load.total.about)
      sum.resultant.moment
        = core::VectorExpression(load.total.moment, "load")(Point<3>())
          + cross_product_3d(Tensor<1, 3>(*load.total.about), sum.resultant.force);
    sum.size = sum.resultant.force.norm() + sum.resultant.moment.norm();
    return sum;
  }

  /** Relative difference of a load's resultant to the other quadrature's. */
  double
  difference(const scene::LoadParameters  &load,
             const Resultant              &computed,
             const mesh::TetMesh          &mesh,
             const mechanics::MaterialMap &materials)
  {
    for (const std::string &text : load.value)
      for (const auto &token : core::expression_tokens(text))
        if (token.is("nx") || token.is("ny") || token.is("nz"))
          return 0.; // the normal is that of the body, not of its facets
    Integral exact;
    switch (load.type)
      {
      case scene::LoadType::traction:
      case scene::LoadType::pressure:
        exact = on_faces(load, mesh);
        break;
      case scene::LoadType::nodal_force:
        exact = on_points(load, mesh);
        break;
      case scene::LoadType::body_force:
      case scene::LoadType::gravity:
      case scene::LoadType::rotation:
        exact = in_cells(load, mesh, materials);
        break;
      case scene::LoadType::temperature:
        break;
      case scene::LoadType::total_force:
        exact = as_given(load, computed);
        break;
      default:
        return 0.; // totals that a scene gives: elsewhere
      }
    const auto [lower, upper] = mesh::bounding_box(mesh);
    const Point<3> centre     = lower + 0.5 * (upper - lower);
    const double   lever      = 0.5 * (upper - lower).norm();
    const double   force      = (computed.force - exact.resultant.force).norm();
    const double   moment
      = (computed.moment_about(centre) - exact.resultant.moment_about(centre)).norm();
    if (exact.size == 0.)
      return force + moment;
    return std::max(force, moment / lever) / exact.size;
  }

  /** Whether files are missing that are no part of the project, or that other runs write. */
  bool
  may_be_missing(const fs::path &file)
  {
    const std::string name = file.filename().string();
    return name.find("femur") != std::string::npos || name.find("_reused") != std::string::npos;
  }

  /** The scene, or the first run of a study. */
  scene::Scene
  read(const fs::path &file)
  {
    scene::Scene scene = scene::read_scene(file.string());
    if (scene.variations.empty())
      return scene;
    scene::Mistakes mistakes;
    return scene::read_study_run(file.string(),
                                 {},
                                 std::vector<unsigned int>(scene.variations.size(), 0),
                                 mistakes);
  }

  /** Coarser than the scene says where that is large. */
  std::shared_ptr<mesh::TetMesh>
  first_mesh(scene::Scene &scene)
  {
    std::shared_ptr<mesh::TetMesh> mesh;
    for (unsigned int attempt = 0; attempt < 4; ++attempt)
      {
        mesh = std::make_shared<mesh::TetMesh>(io::make_mesh(scene, 0, core::Log()));
        if (mesh->n_cells() <= most_cells)
          break;
        for (double &bound : scene.mesh.volume_bounds)
          bound *= 8.;
        if (!scene.mesh.size.empty())
          scene.mesh.size = "2*(" + scene.mesh.size + ")";
        for (auto &cells : scene.mesh.cells)
          for (unsigned int &n : cells)
            n = std::max(1u, n / 2);
      }
    return mesh;
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  unsigned int                                   n_scenes = 0, n_loads = 0;
  bool                                           balanced = true, exact = true;
  std::vector<fs::path>                          files;
  for (const auto &entry : fs::recursive_directory_iterator(SOURCE_DIR "/../../prm"))
    if (entry.path().extension() == ".prm")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path &file : files)
    {
      if (may_be_missing(file))
        continue;
      scene::Scene scene                = read(file);
      const auto   start                = std::chrono::steady_clock::now();
      scene.solver.tolerance            = 1e-12;
      const auto                   mesh = first_mesh(scene);
      const mechanics::MaterialMap materials(scene, *mesh);
      const solve::StaticSystem    system(
        scene, materials, mesh, scene.degree, MPI_COMM_SELF, core::Log());
      const auto solution = system.solve(nullptr, {});
      const auto forces
        = system.equilibrium(solution,
                             mechanics::compute_region_figures(*solution.displacement, materials));
      ++n_scenes;
      if (!(forces.relative_imbalance <= 1e-8) || !forces.is_balanced())
        {
          balanced = false;
          std::cout << file.filename() << ": imbalance " << forces.relative_imbalance
                    << ", allowed " << forces.allowed_imbalance << '\n';
        }
      for (unsigned int l = 0; l < scene.loads.size(); ++l)
        {
          ++n_loads;
          // With large deformation the table has moments at the deformed positions.
          const double error
            = difference(scene.loads[l], solution.loads[l].resultant, *mesh, materials);
          if (!(error <= 1e-6))
            {
              exact = false;
              std::cout << file.filename() << ", " << scene.loads[l].name << ": differs by "
                        << error << '\n';
            }
        }
      if (std::getenv("TETRADAPT_TEST_VERBOSE") != nullptr)
        std::cerr << file.filename() << ' ' << mesh->n_cells() << " cells, "
                  << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()
                  << " s, imbalance " << forces.relative_imbalance << '\n';
    }
  std::cout << "scenes of prm/, more than 50: " << (n_scenes > 50 ? "yes" : "NO")
            << "\nwith loads, more than 40: " << (n_loads > 40 ? "yes" : "NO")
            << "\nall balanced: " << (balanced ? "yes" : "NO")
            << "\nresultants of all loads: " << (exact ? "exact" : "WRONG") << '\n';
}
