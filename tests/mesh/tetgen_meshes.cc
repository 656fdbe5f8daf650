// SPDX-License-Identifier: AGPL-3.0-or-later

// What TetGen makes has the input's volume, patches, regions and points, and the
// sizes that were asked for; the same call gives the same mesh.

#include "tetradapt/core/expression.h"
#include "tetradapt/mesh/mesh_totals.h"
#include "tetradapt/mesh/size_function.h"
#include "tetradapt/mesh/tetgen.h"

#include <cmath>
#include <iostream>

using namespace tetradapt;
using dealii::Point;
using mesh::Sizing;
using mesh::TetMesh;

namespace
{
  std::string
  yes(bool condition)
  {
    return condition ? "yes" : "NO";
  }

  double
  equivalent_edge(const TetMesh &mesh, unsigned int cell)
  {
    return std::cbrt(6. * std::sqrt(2.) * mesh::cell_volume(mesh, cell));
  }

  double
  mean_edge(const TetMesh &mesh)
  {
    double sum = 0.;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      sum += equivalent_edge(mesh, cell);
    return sum / mesh.n_cells();
  }

  bool
  same(const TetMesh &a, const TetMesh &b)
  {
    bool equal = a.points == b.points && a.cells == b.cells && a.regions == b.regions
                 && a.faces.size() == b.faces.size();
    for (std::size_t i = 0; equal && i < a.faces.size(); ++i)
      equal = a.faces[i].vertices == b.faces[i].vertices && a.faces[i].patch == b.faces[i].patch;
    return equal;
  }

  bool
  starts_with(const TetMesh &mesh, const TetMesh &start)
  {
    return mesh.n_points() >= start.n_points()
           && std::equal(start.points.begin(), start.points.end(), mesh.points.begin());
  }

  void
  print(const std::string &name, const TetMesh &mesh)
  {
    const auto totals = mesh::mesh_totals(mesh);
    std::cout << name << ": volume " << totals.volume;
    for (const auto &patch : totals.patches)
      std::cout << ", " << patch.patch.name << ' ' << patch.area;
    for (const auto &[id, region] : totals.regions)
      std::cout << ", region " << id << ' ' << region.volume;
    std::cout << std::endl;
  }

  /** Sizes that are obtained, and the patches and points that are kept. */
  void
  test_sizes(const mesh::Tetgen &tetgen, const TetMesh &box)
  {
    for (const double h : {0.16, 0.08})
      {
        Sizing sizing;
        sizing.node_sizes.assign(box.n_points(), h);
        mesh::TetgenReport report;
        const TetMesh      refined = tetgen.refine(box, sizing, &report);
        print("node sizes", refined);
        std::cout << "  mean edge within 15 % of the wanted one "
                  << yes(std::abs(mean_edge(refined) / h - 1.) < .15) << ", points stay "
                  << yes(starts_with(refined, box)) << ", new points counted "
                  << yes(report.new_points == refined.n_points() - box.n_points())
                  << ", same mesh twice " << yes(same(refined, tetgen.refine(box, sizing)))
                  << std::endl;
      }

    // Cells that reach into the left half get a bound.
    const auto least_x = [](const TetMesh &mesh, unsigned int cell) {
      double x = 1e9;
      for (const unsigned int v : mesh.cells[cell])
        x = std::min(x, mesh.points[v][0]);
      return x;
    };
    Sizing sizing;
    sizing.cell_volumes.assign(box.n_cells(), 0.);
    for (unsigned int cell = 0; cell < box.n_cells(); ++cell)
      if (least_x(box, cell) < 1.)
        sizing.cell_volumes[cell] = 0.0005;
    const TetMesh refined = tetgen.refine(box, sizing);
    print("cell volumes", refined);
    unsigned int n_large = 0, n_left = 0;
    for (unsigned int cell = 0; cell < refined.n_cells(); ++cell)
      if (least_x(refined, cell) < .9)
        {
          ++n_left;
          n_large += mesh::cell_volume(refined, cell) > 0.0005;
        }
    std::cout << "  cells above their bound: " << n_large << ", most cells where asked for "
              << yes(n_left > .7 * refined.n_cells()) << std::endl;
  }

  void
  test_nothing_to_do(const mesh::Tetgen &tetgen, const TetMesh &box)
  {
    mesh::TetgenReport report;
    Sizing             sizing;
    const bool         unchanged = same(tetgen.refine(box, sizing, &report), box);
    std::cout << "no sizes: unchanged " << yes(unchanged && !report.called);
    sizing.max_volume = 10.;
    sizing.node_sizes.assign(box.n_points(), 3.);
    const bool large = same(tetgen.refine(box, sizing, &report), box);
    std::cout << ", large sizes: unchanged " << yes(large && !report.called) << std::endl;
  }

  /** Regions whose border is ragged, patches whose border lies within a plane. */
  void
  test_ids(const mesh::Tetgen &tetgen, TetMesh box)
  {
    box.region_names[-3] = "marrow";
    for (unsigned int cell = 0; cell < box.n_cells(); ++cell)
      box.regions[cell] = box.points[box.cells[cell][0]][0] < 1. ? 7 : -3;
    box.patches.push_back(box.patches[0]);
    box.patches.back().selections = {"clamp"};
    for (auto &face : box.faces)
      if (face.patch == 0 && box.points[face.vertices[0]][1] < 0.5)
        face.patch = 6;
    Sizing sizing;
    sizing.node_sizes.assign(box.n_points(), 0.1);
    const TetMesh refined = tetgen.refine(box, sizing);
    std::cout << "ids: everything kept "
              << yes(mesh::compare_totals(mesh::mesh_totals(box), mesh::mesh_totals(refined), 1e-12)
                       .empty())
              << ", region name " << refined.region_names.at(-3) << ", selection "
              << refined.patches[6].selections.at(0) << std::endl;
  }

  void
  test_cap_and_boundary(scene::TetgenParameters parameters, const TetMesh &box)
  {
    Sizing sizing;
    sizing.node_sizes.assign(box.n_points(), 0.08);
    parameters.steiner_points = 100;
    mesh::TetgenReport report;
    const TetMesh      capped = mesh::Tetgen(parameters).refine(box, sizing, &report);
    std::cout << "cap of 100: new points " << report.new_points << ", reached "
              << yes(report.cap_reached);
    sizing.node_sizes.assign(capped.n_points(), 0.08);
    mesh::Tetgen(parameters).refine(capped, sizing, &report);
    std::cout << ", again: new points " << report.new_points << std::endl;

    parameters.steiner_points = -1;
    parameters.keep_boundary  = true;
    sizing.node_sizes.assign(box.n_points(), 0.08);
    const TetMesh kept = mesh::Tetgen(parameters).refine(box, sizing, &report);
    std::cout << "boundary kept: same number of faces "
              << yes(kept.faces.size() == box.faces.size()) << ", more cells "
              << yes(kept.n_cells() > 2 * box.n_cells()) << std::endl;
    mesh::Tetgen(parameters)
      .mesh(mesh::box_complex(Point<3>(0, 0, 0), Point<3>(1, 1, 1)), {0.001, {}, {}}, &report);
    std::cout << "boundary of a new mesh kept: cells above the bound reported "
              << yes(report.oversized_cells > 0) << std::endl;
  }

  void
  test_size_function(const mesh::Tetgen &tetgen)
  {
    const TetMesh start
      = tetgen.mesh(mesh::box_complex(Point<3>(0, 0, 0), Point<3>(2, 1, 1)), Sizing());
    const core::Expression size("0.04 + 0.2 * sqrt(x^2 + y^2 + z^2)", "test");
    mesh::SizeReport       report;
    const TetMesh          mesh = mesh::mesh_with_size(tetgen, start, size, &report);
    print("size function", mesh);
    std::cout << "  cells above 1.5 times their size: " << report.oversized_cells
              << ", passes up to 4 " << yes(report.passes >= 1 && report.passes <= 4)
              << ", mean ratio within .7 to 1.1 "
              << yes(report.mean_ratio > .7 && report.mean_ratio < 1.1) << ", points stay "
              << yes(starts_with(mesh, start)) << std::endl;

    // A detail in the middle of a coarse cell is found.
    const core::Expression spot("0.03 + 0.5 * sqrt((x-1)^2 + (y-0.5)^2 + (z-0.5)^2)", "test");
    const TetMesh          fine  = mesh::mesh_with_size(tetgen, start, spot, &report);
    double                 least = 1.;
    for (unsigned int cell = 0; cell < fine.n_cells(); ++cell)
      least = std::min(least, equivalent_edge(fine, cell));
    std::cout << "spot: cells above 1.5 times their size: " << report.oversized_cells
              << ", smallest cell below 0.05 " << yes(least < .05) << std::endl;
  }

  void
  test_surfaces(const mesh::Tetgen &tetgen)
  {
    // Two boxes in one surface, with points inside both; one seed a region.
    auto       plc   = mesh::box_complex(Point<3>(0, 0, 0), Point<3>(1, 1, 1));
    const auto other = mesh::box_complex(Point<3>(2, 0, 0), Point<3>(3, 1, 0.5));
    plc.points.insert(plc.points.end(), other.points.begin(), other.points.end());
    for (auto facet : other.facets)
      {
        for (unsigned int &v : facet.vertices)
          v += 8;
        plc.facets.push_back(facet);
      }
    plc.name    = "two boxes";
    plc.regions = {{Point<3>(.5, .5, .5), 4}, {Point<3>(2.5, .5, .25), 9}};
    print(plc.name, tetgen.mesh(plc, {0.01, {}, {}}));

    // Unchanged as a triangulated surface, with ids as patches.
    auto surface = mesh::triangulate(mesh::box_complex(Point<3>(0, 0, 0), Point<3>(1, 2, 3)));
    for (int &id : surface.ids)
      id = id < 2 ? 20 : 10;
    const auto box = mesh::surface_complex(surface, "surface");
    std::cout << "ids of the surface's patches: " << box.patches.at(0).boundary_id << ' '
              << box.patches.at(1).boundary_id << std::endl;
    print("surface", tetgen.mesh(box, Sizing()));
  }
} // namespace

int
main()
{
  scene::TetgenParameters parameters;
  const mesh::Tetgen      tetgen(parameters);
  Sizing                  sizing;
  sizing.max_volume = 0.02;
  mesh::TetgenReport report;
  const auto         complex = mesh::box_complex(Point<3>(0, 0, 0), Point<3>(2, 1, 1));
  const TetMesh      box     = tetgen.mesh(complex, sizing, &report);
  print("box", box);
  std::cout << "  cells above the bound: " << report.oversized_cells << ", same mesh twice "
            << yes(same(box, tetgen.mesh(complex, sizing))) << std::endl;

  test_sizes(tetgen, box);
  test_nothing_to_do(tetgen, box);
  test_ids(tetgen, box);
  test_cap_and_boundary(parameters, box);
  test_size_function(tetgen);
  test_surfaces(tetgen);
}
