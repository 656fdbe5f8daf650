// SPDX-License-Identifier: AGPL-3.0-or-later
// The boundary of a sphere's eighth stays on its spheres and planes while the mesh is refined,
// its volume approaches the true one with h^2, no tetrahedron degenerates; bodies are
// meshed from scratch from the corners of their flat parts.

#include "tetradapt/io/volume_reader.h"
#include "tetradapt/mesh/body_complex.h"
#include "tetradapt/mesh/boundary_projection.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/mesh/mesh_totals.h"
#include "tetradapt/mesh/red_refinement.h"
#include "tetradapt/mesh/tetgen.h"

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace tetradapt;
using mesh::Point;
using mesh::TetMesh;

namespace
{
  const double true_volume = dealii::numbers::PI / 6. * 7.;

  /** Largest distance of a boundary point from the surfaces that its faces' ids name: 1 and 2 are
   * the spheres, 3 to 5 the planes. */
  double
  largest_distance(const TetMesh &mesh)
  {
    double largest = 0.;
    for (const auto &face : mesh.faces)
      for (const unsigned int v : face.vertices)
        {
          const int    id = mesh.patches[face.patch].boundary_id;
          const double r  = mesh.points[v].norm();
          largest         = std::max(largest, std::abs(id <= 2 ? r - id : mesh.points[v][id - 3]));
        }
    return largest;
  }

  double
  worst_cell(const TetMesh &mesh)
  {
    double worst = 1.;
    for (const auto &c : mesh.cells)
      worst = std::min(worst,
                       mesh::mean_ratio(mesh.points[c[0]],
                                        mesh.points[c[1]],
                                        mesh.points[c[2]],
                                        mesh.points[c[3]]));
    return worst;
  }

  void
  test_sphere(const mesh::BoundaryProjection &projection)
  {
    TetMesh mesh = io::read_volume_mesh(SOURCE_DIR "/../../meshes/sphere_octant.msh");
    projection.assign(mesh);
    std::cout << "patches:";
    for (const auto &patch : mesh.patches)
      std::cout << " [" << mesh::describe(patch) << "]";
    std::cout << "\nfirst mesh: moved " << projection.project(mesh).n_moved << ", volume error "
              << 1. - mesh::total_volume(mesh) / true_volume << "\n";
    const auto body_is_within = [&](const double error) {
      return std::abs(projection.body_volume(mesh) / true_volume - 1.) < error ? "yes" : "NO";
    };
    std::cout << "volume of the body from this mesh, to 1e-3: " << body_is_within(1e-3) << '\n';
    double before = 1. - mesh::total_volume(mesh) / true_volume;
    for (unsigned int i = 0; i < 4; ++i)
      {
        mesh                         = mesh::red_refine(mesh);
        const mesh::MoveReport moves = projection.project(mesh);
        mesh::finalize(mesh, "the sphere");
        const double error = 1. - mesh::total_volume(mesh) / true_volume;
        if (i < 2)
          std::cout << "volume of the body, to " << (i == 0 ? "1e-4: " : "1e-6: ")
                    << body_is_within(i == 0 ? 1e-4 : 1e-6) << '\n';
        std::cout
          << mesh.n_cells() << " cells: held " << moves.n_held << ", on the surfaces "
          << (largest_distance(mesh) < 1e-10 ? "yes" : "NO") << ", worst cell above 0.05 "
          << (worst_cell(mesh) > 0.05 ? "yes" : "NO") << ", order of the volume "
          << (i == 0
                ? "-"
                : std::to_string(std::lround(10. * std::log2(before / error)) / 10.).substr(0, 3))
          << '\n';
        before = error;
      }
    const auto points = mesh.points;
    std::cout << "again: moved " << projection.project(mesh).n_moved << ", points as they were "
              << (points == mesh.points ? "yes" : "NO") << '\n';
  }

  /** A move that would turn cells inside out is stopped on the way. */
  void
  test_guard()
  {
    TetMesh cube = mesh::Tetgen(scene::TetgenParameters())
                     .mesh(mesh::box_complex(Point<3>(0, 0, 0), Point<3>(1, 1, 1)), {0.02, {}, {}});
    const double                 volume = mesh::total_volume(cube);
    std::vector<mesh::PointMove> moves;
    for (unsigned int p = 0; p < cube.n_points(); ++p)
      if (cube.points[p][2] == 1. && cube.points[p][0] > 0.2 && cube.points[p][0] < 0.8)
        moves.push_back({p, cube.points[p] + mesh::Tensor<1, 3>({0., 0., -0.9})});
    const auto report = mesh::move_points(cube, moves);
    mesh::finalize(cube, "the cube"); // throws for a negative or flat cell
    std::cout << "pressed cube: held some " << (report.n_held > 0 ? "yes" : "NO")
              << ", no cell below 0.02 " << (worst_cell(cube) > 0.02 ? "yes" : "NO")
              << ", volume changed by what the faces swept at most "
              << (volume - mesh::total_volume(cube) <= report.swept_volume ? "yes" : "NO") << '\n';
  }

  /** Two regions with a slanted wall, refined, then meshed from scratch with large cells. */
  void
  test_body()
  {
    const mesh::Tetgen tetgen{scene::TetgenParameters()};
    TetMesh            fine
      = tetgen.mesh(mesh::box_complex(Point<3>(0, 0, 0), Point<3>(2, 1, 1)), {0.0005, {}, {}});
    // A face of another patch in the midst of its side.
    for (auto &face : fine.faces)
      {
        double least = 1.;
        for (const unsigned int v : face.vertices)
          least = std::min({least, fine.points[v][1], 1. - fine.points[v][1]});
        if (face.patch == 5 && least > 0.3)
          {
            face.patch = 0;
            break;
          }
      }
    for (unsigned int c = 0; c < fine.n_cells(); ++c)
      {
        double x = 0.;
        for (const unsigned int v : fine.cells[c])
          x += fine.points[v][0] / 4.;
        fine.regions[c] = x < 0.7 ? 3 : 5;
      }
    mesh::finalize(fine, "the box");
    const auto body = [&](double size) {
      return mesh::body_complex(fine,
                                std::vector<double>(fine.n_points(), size),
                                mesh::build_edges(fine));
    };
    const auto coarse = body(0.5);
    const auto anew   = tetgen.mesh(coarse.plc, coarse.sizing);
    const auto lost = mesh::compare_totals(mesh::mesh_totals(fine), mesh::mesh_totals(anew), 1e-9);
    const auto repeat = tetgen.mesh(body(0.5).plc, body(0.5).sizing);
    std::cout << "two regions: fewer cells " << (2 * anew.n_cells() < fine.n_cells() ? "yes" : "NO")
              << ", complaints " << lost.size() << ", the same again "
              << (repeat.points == anew.points && repeat.cells == anew.cells ? "yes" : "NO")
              << '\n';

    std::fill(fine.regions.begin(), fine.regions.end(), 0);
    const auto box = mesh::body_complex(fine,
                                        std::vector<double>(fine.n_points(), 10.),
                                        mesh::build_edges(fine));
    std::cout << "one region: " << box.plc.facets.size() << " facets of " << box.plc.points.size()
              << " points, the box's and those of the lone face; less than 100 cells "
              << (tetgen.mesh(box.plc, box.sizing).n_cells() < 100 ? "yes" : "NO") << '\n';
  }
} // namespace

int
main()
{
  scene::Scene           scene;
  scene::MeshParameters &parameters = scene.mesh;
  parameters.source                 = scene::MeshSource::file;
  parameters.projection             = scene::MeshParameters::Projection::expression;
  parameters.projection_functions   = {"x^2+y^2+z^2-1", "x^2+y^2+z^2-4"};
  test_sphere(*mesh::make_projection(scene));
  parameters.projection_functions = {"x^2+y^2+z^2-1", "z-7"};
  try
    {
      TetMesh mesh = io::read_volume_mesh(SOURCE_DIR "/../../meshes/sphere_octant.msh");
      mesh::make_projection(scene)->assign(mesh);
    }
  catch (const std::exception &error)
    {
      std::cout << error.what() << '\n';
    }
  test_guard();
  test_body();
}
