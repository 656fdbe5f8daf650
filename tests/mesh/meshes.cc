// SPDX-License-Identifier: AGPL-3.0-or-later
// Bricks with the counts of the 2015 report's Table 4.1, red refinement, edges,
// quality of known tetrahedra, parts, and what finalize() repairs and refuses.

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/mesh/mesh_totals.h"
#include "tetradapt/mesh/quality.h"
#include "tetradapt/mesh/red_refinement.h"

#include <cmath>
#include <functional>
#include <iostream>

using namespace tetradapt;
using namespace tetradapt::mesh;

void
check(const std::string &what, const bool holds)
{
  std::cout << what << ": " << (holds ? "yes" : "NO") << std::endl;
}

bool
is_finalized(TetMesh mesh)
{
  const auto cells  = mesh.cells;
  const auto report = finalize(mesh, "a finalized mesh");
  for (const auto &face : mesh.faces)
    if (face.patch >= mesh.patches.size())
      return false;
  return mesh.cells == cells && report.removed_points == 0 && report.flipped_cells == 0
         && report.added_faces == 0 && report.dropped_interior_faces == 0
         && report.dropped_repeated_faces == 0;
}

/** The sum of outward area vectors of a closed surface is zero, the flux of x/3
 * the volume: both only if every face is turned outwards. */
double
flux(const TetMesh &mesh)
{
  double sum = 0.;
  for (const auto &face : mesh.faces)
    sum += face_area_vector(mesh, face)
           * (mesh.points[face.vertices[0]] + mesh.points[face.vertices[1]]
              + mesh.points[face.vertices[2]])
           / 9.;
  return sum;
}

void
test_bricks()
{
  std::cout << "Table 4.1: n m points tets" << std::endl;
  for (const auto &[n, m] : std::vector<std::pair<unsigned int, unsigned int>>{
         {1, 7}, {1, 11}, {2, 13}, {2, 16}, {3, 18}, {3, 22}, {4, 26}, {6, 36}, {7, 42}})
    {
      const TetMesh mesh = bricks({0., 0., 0.}, {1., 1., 6.}, {{n, n, m}});
      std::cout << n << ' ' << m << ' ' << mesh.n_points() << ' ' << mesh.n_cells() << std::endl;
    }

  const TetMesh    mesh   = bricks({-1., 0., 2.}, {1., 3., 3.}, {{2, 3, 4}});
  const MeshTotals totals = mesh_totals(mesh);
  std::cout << "volume " << totals.volume << " flux " << flux(mesh) << std::endl;
  for (const auto &entry : totals.patches)
    std::cout << entry.patch.boundary_id << ' ' << entry.patch.name << ' ' << entry.n_faces << ' '
              << entry.area << std::endl;
  check("bricks are finalized", is_finalized(mesh));
  const auto [lower, upper] = bounding_box(mesh);
  std::cout << "box " << to_string(lower) << ' ' << to_string(upper) << std::endl;
}

void
test_refinement()
{
  TetMesh mesh = bricks({0., 0., 0.}, {2., 1., 1.}, {{2, 1, 2}});
  for (auto &point : mesh.points) // no two diagonals of the same length
    point += Tensor<1, 3>({0.1 * point[1] * point[2], 0.05 * point[0] * point[2], 0.07 * point[0]});
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    mesh.regions[c] = c % 2;
  mesh.region_names[1] = "odd";

  const EdgeTable edges = build_edges(mesh);
  const TetMesh   fine  = red_refine(mesh);
  // Euler: V - E + F - C = 1 with F = (4 C + boundary faces) / 2.
  const int faces = (4 * mesh.n_cells() + mesh.faces.size()) / 2;
  std::cout << "edges " << edges.edges.size() << ", Euler characteristic "
            << int(mesh.n_points()) - int(edges.edges.size()) + faces - int(mesh.n_cells())
            << std::endl;
  unsigned int     next     = 0;
  bool             in_order = true, right_ends = true;
  const EdgeFinder finder(edges, mesh.n_points());
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    for (unsigned int e = 0; e < 6; ++e)
      {
        const unsigned int edge = edges.cell_edges[c][e];
        const unsigned int a    = mesh.cells[c][edge_vertices[e][0]];
        const unsigned int b    = mesh.cells[c][edge_vertices[e][1]];
        in_order                = in_order && edge <= next;
        next                    = std::max(next, edge + 1);
        right_ends              = right_ends && edges.edges[edge][0] == std::min(a, b)
                     && edges.edges[edge][1] == std::max(a, b) && finder.find(b, a) == edge;
      }
  check("edges are numbered as cells name them", in_order && next == edges.edges.size());
  check("edges have the right ends and are found", right_ends);
  check("no edge is found where there is none",
        finder.find(0, 0) == dealii::numbers::invalid_unsigned_int);

  const MeshTotals coarse_totals = mesh_totals(mesh), fine_totals = mesh_totals(fine);
  std::cout << "refined: " << fine.n_points() << " points, " << fine.n_cells() << " tets, "
            << fine.faces.size() << " faces" << std::endl;
  check("refined mesh is finalized", is_finalized(fine));
  check("volumes and areas are kept", compare_totals(coarse_totals, fine_totals, 1e-14).empty());
  bool middles = true;
  for (unsigned int e = 0; e < edges.edges.size(); ++e)
    middles
      = middles
        && (fine.points[mesh.n_points() + e]
            - 0.5 * (mesh.points[edges.edges[e][0]] + Tensor<1, 3>(mesh.points[edges.edges[e][1]])))
               .norm()
             < 1e-15;
  check("new points are the middles of edges", middles);
  double worst = 0.;
  for (unsigned int c = 0; c < fine.n_cells(); ++c)
    worst = std::max(worst, std::abs(cell_volume(fine, c) / cell_volume(mesh, c / 8) - 0.125));
  check("every part is an eighth of its cell", worst < 1e-12);
}

/** One tetrahedron. */
TetMesh
tetrahedron(const Point<3> &a, const Point<3> &b, const Point<3> &c, const Point<3> &d)
{
  TetMesh mesh;
  mesh.points = {a, b, c, d};
  mesh.cells  = {{{0, 1, 2, 3}}};
  return mesh;
}

void
print(const std::string &what, const CellQuality &q)
{
  std::cout << what << ": angles " << q.min_dihedral << ' ' << q.max_dihedral << " radius-edge "
            << q.radius_edge << " aspect " << q.aspect_ratio << " radius ratio " << q.radius_ratio
            << " edges " << q.shortest_edge << ' ' << q.longest_edge << std::endl;
}

void
test_quality()
{
  // acos(1/3) = 70.5288, sqrt(6)/4 = 0.612372, sqrt(3/2) = 1.22474, 1.
  print("regular",
        cell_quality(tetrahedron({1., 1., 1.}, {-1., 1., -1.}, {1., -1., -1.}, {-1., -1., 1.}), 0));
  // Corner of a cube: angles 90 and acos(1/sqrt 3) = 54.7356; circumradius
  // sqrt(3)/2, inradius 1/(3 + sqrt 3), smallest height 1/sqrt 3.
  print("corner",
        cell_quality(tetrahedron({0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}), 0));
  // A sliver: angles tend to 0 and 180, but radius-edge stays 1/sqrt 2.
  print("sliver",
        cell_quality(
          tetrahedron({1., 0., 0.01}, {-1., 0., 0.01}, {0., 1., -0.01}, {0., -1., -0.01}), 0));
  const MeshQuality quality = mesh_quality(bricks({0., 0., 0.}, {1., 1., 1.}, {{3, 3, 3}}));
  std::cout << "bricks: " << quality.min_dihedral.min << ' ' << quality.max_dihedral.max << ' '
            << quality.aspect_ratio.mean << ' ' << quality.radius_edge.max << ' '
            << quality.min_dihedral_histogram.counts[9] << std::endl;
}

void
refuses(TetMesh mesh)
{
  try
    {
      finalize(mesh, "the mesh");
      std::cout << "NOT REFUSED" << std::endl;
    }
  catch (const core::InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}

void
test_finalize()
{
  TetMesh mesh = bricks({0., 0., 0.}, {1., 1., 1.}, {{1, 1, 1}});
  mesh.points.insert(mesh.points.begin(), Point<3>(5., 5., 5.));
  for (auto &cell : mesh.cells)
    for (auto &v : cell)
      ++v;
  for (auto &face : mesh.faces)
    for (auto &v : face.vertices)
      ++v;
  std::swap(mesh.cells[2][0], mesh.cells[2][1]);
  std::swap(mesh.faces[0].vertices[0], mesh.faces[0].vertices[1]);
  mesh.faces.push_back(mesh.faces[3]);
  mesh.faces.erase(mesh.faces.begin() + 5);
  mesh.faces.push_back({{{1, 2, 8}}, 0}); // inside: holds the main diagonal
  mesh.regions.clear();
  const FinalizeReport report = finalize(mesh, "the mesh");
  std::cout << "repaired: points " << report.removed_points << ", turned " << report.flipped_cells
            << ", added " << report.added_faces << ", inside " << report.dropped_interior_faces
            << ", repeated " << report.dropped_repeated_faces << "; flux " << flux(mesh)
            << ", last patch has id " << mesh.patches.back().boundary_id << std::endl;
  check("repaired mesh is finalized", is_finalized(mesh));

  const TetMesh good = bricks({0., 0., 0.}, {1., 1., 1.}, {{1, 1, 1}});
  const auto    with = [&](const std::function<void(TetMesh &)> &change) {
    TetMesh bad = good;
    change(bad);
    refuses(bad);
  };
  refuses(TetMesh());
  with([](TetMesh &m) { m.cells[1][2] = 99; });
  with([](TetMesh &m) { m.cells[1][2] = m.cells[1][3]; });
  with([](TetMesh &m) { m.points[6][1] = std::nan(""); });
  with([](TetMesh &m) { m.regions.pop_back(); });
  with([](TetMesh &m) { m.faces[0].patch = 17; });
  with([](TetMesh &m) { m.faces[3].vertices = {{1, 2, 6}}; });
  with([](TetMesh &m) { m.faces.push_back({m.faces[0].vertices, 3}); });
  with([](TetMesh &m) {
    m.points.push_back(m.points[7]);
    m.cells[0][3] = 8;
  });
  with([](TetMesh &m) { m.points[7] = Point<3>(1., 0., 0.5); });
  with([](TetMesh &m) {
    m.cells.push_back(m.cells[4]);
    m.regions.push_back(0);
  });
  with([](TetMesh &m) { // a cell on the same side of a boundary face as another
    m.points.emplace_back(0.3, 0.4, 0.5);
    m.cells.push_back({{0, 2, 6, 8}});
    m.regions.push_back(0);
  });

  for (const auto &[upper, n] : std::vector<std::pair<Point<3>, std::array<unsigned int, 3>>>{
         {{1., 1., 1.}, {{1, 0, 1}}},
         {{1., -1., 1.}, {{1, 1, 1}}},
         {{1., 1., INFINITY}, {{1, 1, 1}}},
         {{1., 1., 1.}, {{100000, 100000, 100000}}},
         {{1., 1., 4e-324}, {{1, 1, 2}}}})
    try
      {
        bricks({0., 0., 0.}, upper, n);
        std::cout << "NOT REFUSED" << std::endl;
      }
    catch (const core::InputError &error)
      {
        std::cout << error.what() << std::endl;
      }
}

void
test_parts_and_totals()
{
  TetMesh    mesh  = bricks({0., 0., 0.}, {1., 1., 1.}, {{2, 2, 2}});
  const auto other = bricks({2., 0., 0.}, {3., 1., 1.}, {{1, 1, 1}});
  const auto first = mesh.n_points();
  for (auto cell : other.cells)
    {
      for (auto &v : cell)
        v += first;
      mesh.cells.push_back(cell);
      mesh.regions.push_back(5);
    }
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  finalize(mesh, "two boxes");
  const auto part = connected_components(mesh);
  std::cout << "parts of cell 0, 47, 48, 53: " << part[0] << part[47] << part[48] << part[53]
            << std::endl;

  const MeshTotals before = mesh_totals(mesh);
  for (auto &face : mesh.faces)
    if (face.patch == 2)
      face.patch = 3;
  for (auto &region : mesh.regions)
    region = 1;
  for (auto &point : mesh.points)
    point[2] *= 1.001;
  for (const std::string &complaint : compare_totals(before, mesh_totals(mesh)))
    std::cout << complaint << std::endl;
}

int
main()
{
  test_bricks();
  test_refinement();
  test_quality();
  test_finalize();
  test_parts_and_totals();
}
