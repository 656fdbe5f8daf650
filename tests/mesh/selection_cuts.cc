// SPDX-License-Identifier: AGPL-3.0-or-later
// What is selected of a box, of blocks with a wall inside and of a surface has its exact area on
// the first mesh, on refined ones and on those that are made anew with coarser cells.

#include "tetradapt/mesh/selection_cuts.h"

#include "tetradapt/geometry/surface_io.h"
#include "tetradapt/io/mesh_source.h"
#include "tetradapt/mesh/blocks.h"
#include "tetradapt/mesh/body_complex.h"
#include "tetradapt/mesh/boundary_projection.h"
#include "tetradapt/mesh/edges.h"
#include "tetradapt/mesh/red_refinement.h"
#include "tetradapt/mesh/selection.h"
#include "tetradapt/mesh/tetgen.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <set>

using namespace tetradapt;
using namespace tetradapt::mesh;

struct Wanted
{
  std::string where, group;
  double      area, tolerance;
};

void
check(const std::string &what, const TetMesh &mesh, const std::vector<Wanted> &wanted)
{
  const auto areas = selected_areas(mesh);
  for (unsigned int i = 0; i < wanted.size(); ++i)
    {
      const double area = areas.at("Loads/" + std::to_string(i));
      if (std::abs(area - wanted[i].area) <= wanted[i].tolerance * wanted[i].area)
        std::cout << "  " << what << ", " << wanted[i].where << ": right" << std::endl;
      else
        std::cout << "  " << what << ", " << wanted[i].where << ": WRONG " << area << ", not "
                  << wanted[i].area << std::endl;
    }
}

core::Log
log_of_warnings()
{
  core::Log log;
  log.add_sink([](const core::LogLevel level, const std::string &text) {
    if (level == core::LogLevel::warning)
      std::cout << "  warning: " << text << std::endl;
  });
  return log;
}

void
run(const PiecewiseLinearComplex &plc, const std::vector<Wanted> &wanted)
{
  std::vector<std::pair<std::string, scene::Selector>> selectors;
  for (unsigned int i = 0; i < wanted.size(); ++i)
    {
      scene::Selector selector;
      selector.where = wanted[i].where;
      if (!wanted[i].group.empty())
        selector.groups = {wanted[i].group};
      selectors.emplace_back("Loads/" + std::to_string(i), selector);
    }
  std::cout << plc.name << ": " << plc.facets.size() << " facets, ";
  const auto cut = with_selections(
    plc, selectors, [](const Point<3> &) { return .3; }, log_of_warnings());
  std::cout << (cut.facets.size() == plc.facets.size() ? "none new" : "with new ones") << std::endl;
  const Tetgen tetgen{scene::TetgenParameters()};
  Sizing       coarse;
  coarse.max_volume   = .02;
  const TetMesh first = tetgen.mesh(cut, coarse);
  check("first", first, wanted);
  Sizing fine;
  fine.max_volume       = .002;
  const TetMesh refined = tetgen.refine(first, fine);
  check("refined", refined, wanted);
  const EdgeTable   edges = build_edges(refined);
  const BodyComplex body
    = body_complex(refined, std::vector<double>(refined.n_points(), .5), edges);
  const TetMesh anew = tetgen.mesh(body.plc, body.sizing);
  std::cout << "  coarser: " << (anew.n_cells() < refined.n_cells()) << std::endl;
  check("anew", anew, wanted);
}

/** An octahedron whose triangles were cut into four three times and lie on a sphere, as a
 * file. */
void
write_sphere(const std::string &file)
{
  std::vector<Point<3>> points{
    {1., 0., 0.}, {-1., 0., 0.}, {0., 1., 0.}, {0., -1., 0.}, {0., 0., 1.}, {0., 0., -1.}};
  std::vector<std::array<unsigned int, 3>> triangles;
  for (unsigned int i = 0; i < 8; ++i)
    {
      const unsigned int x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2);
      if ((x + y + z) % 2 == 0)
        triangles.push_back({{x, y, z}});
      else
        triangles.push_back({{y, x, z}});
    }
  for (unsigned int level = 0; level < 3; ++level)
    {
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> middles;
      const auto middle = [&](unsigned int a, unsigned int b) {
        const auto [entry, is_new] = middles.emplace(std::minmax(a, b), points.size());
        if (is_new)
          {
            const Tensor<1, 3> sum = points[a] + Tensor<1, 3>(points[b]);
            points.emplace_back(sum / sum.norm());
          }
        return entry->second;
      };
      std::vector<std::array<unsigned int, 3>> finer;
      for (const auto &[a, b, c] : triangles)
        {
          const unsigned int p = middle(a, b), q = middle(b, c), r = middle(c, a);
          finer.insert(finer.end(), {{{a, p, r}}, {{p, b, q}}, {{r, q, c}}, {{p, q, r}}});
        }
      triangles = finer;
    }
  std::ofstream out(file);
  out.precision(17);
  out << "OFF\n" << points.size() << ' ' << triangles.size() << " 0\n";
  for (const auto &p : points)
    out << p << '\n';
  for (const auto &t : triangles)
    out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
}

scene::Selector
selector_where(const std::string &where)
{
  scene::Selector selector;
  selector.where = where;
  return selector;
}

/** On the triangles of a curved surface, areas stay what they are on the first mesh, and a
 * border through points and along edges cuts nothing. */
void
test_surface()
{
  const auto surface
    = surface_complex(geometry::read_surface("sphere.off"), "the triangles of a sphere");
  const auto size    = [](const Point<3> &) { return .3; };
  const auto through = with_selections(surface,
                                       {{"Loads/half", selector_where("z > 0")},
                                        {"Loads/quarter", selector_where("x > 0 && y >= 0")}},
                                       size,
                                       log_of_warnings());
  std::cout << surface.name << ": new points " << through.points.size() - surface.points.size()
            << std::endl;
  const auto    cut = with_selections(surface,
                                   {{"Loads/cap", selector_where("z > .55 && x > .1")},
                                       {"Loads/disc", selector_where("(x-.1)^2 + y^2 < .2 && z < 0")}},
                                   size,
                                   core::Log());
  const Tetgen  tetgen{scene::TetgenParameters()};
  Sizing        sizing;
  const TetMesh first       = tetgen.mesh(cut, sizing);
  sizing.max_volume         = .002;
  const TetMesh     refined = tetgen.refine(first, sizing);
  const BodyComplex body
    = body_complex(refined, std::vector<double>(refined.n_points(), .5), build_edges(refined));
  const TetMesh anew  = tetgen.mesh(body.plc, body.sizing);
  const auto    areas = selected_areas(first);
  for (const TetMesh *mesh : {&refined, &anew})
    for (const auto &[name, area] : selected_areas(*mesh))
      std::cout << "  " << name << " the same: " << (std::abs(area - areas.at(name)) < 1e-9 * area)
                << std::endl;
  // Projected along z, the disc's area is known. On the triangles' edges its border stays on
  // the circle, so that the polygon is smaller.
  double projected = 0.;
  for (const auto &face : first.faces)
    {
      const auto &names = first.patches[face.patch].selections;
      if (std::count(names.begin(), names.end(), "Loads/disc") > 0)
        projected += std::abs(face_area_vector(first, face)[2]);
    }
  std::cout << "  disc: " << (std::abs(projected / (.2 * std::acos(-1.)) - 1.) < 1e-2) << std::endl;
}

/** A strip much narrower than the wanted size is cut, with a warning. */
void
test_warning()
{
  const auto box = box_complex({0., 0., 0.}, {1., 1., 1.});
  const auto cut = with_selections(
    box,
    {{"Loads/strip", selector_where("z > 1-1e-9 && x < .0025")}},
    [](const Point<3> &) { return .3; },
    log_of_warnings());
  std::cout << "a narrow strip: new points " << cut.points.size() - box.points.size() << std::endl;
}

/** On a projected ball, selected areas converge to those of the sphere. */
void
test_projection()
{
  const double pi = std::acos(-1.);
  write_sphere("sphere.off");
  scene::Scene scene;
  scene.mesh.source               = scene::MeshSource::surface;
  scene.mesh.files                = {"sphere.off"};
  scene.mesh.projection           = scene::MeshParameters::Projection::expression;
  scene.mesh.projection_functions = {"x^2 + y^2 + z^2 - 1"};
  const std::vector<std::pair<std::string, double>> loads{{"z > .55", 2. * pi * .45},
                                                          {"z > .55 && x > .1", 0.},
                                                          {"cylinder(0,0,0, 1,0,0, .3)",
                                                           2. * pi * (1. - std::sqrt(1. - .09))}};
  for (unsigned int i = 0; i < loads.size(); ++i)
    {
      scene::LoadParameters load;
      load.name           = std::to_string(i);
      load.selector.where = loads[i].first;
      scene.loads.push_back(load);
    }
  const auto projection = make_projection(scene);
  TetMesh    mesh       = io::make_mesh(scene, 0, core::Log());
  for (unsigned int round = 0; round < 3; ++round)
    {
      if (round > 0)
        {
          mesh = red_refine(mesh);
          projection->project(mesh);
        }
      const auto areas = selected_areas(mesh);
      // The nodes on the edge of the cap, where z = .55.
      std::cout << "  on a sphere, round " << round << ":";
      for (const unsigned int i : {0, 2})
        {
          // Of the polyhedron's size, which falls by four.
          const double error = areas.at("Loads/" + std::to_string(i)) / loads[i].second - 1.;
          std::cout << ' ' << (std::abs(error) < .006 * std::pow(.25, round));
        }
      std::set<unsigned int> inside, outside;
      for (const auto &face : mesh.faces)
        {
          const auto &names = mesh.patches[face.patch].selections;
          const bool  is_in = std::count(names.begin(), names.end(), "Loads/0") > 0;
          for (const unsigned int v : face.vertices)
            (is_in ? inside : outside).insert(v);
        }
      double farthest = 0.;
      for (const unsigned int v : inside)
        if (outside.count(v) > 0)
          farthest = std::max({farthest,
                               std::abs(mesh.points[v][2] - .55),
                               std::abs(Tensor<1, 3>(mesh.points[v]).norm() - 1.)});
      std::cout << ", border on both " << (farthest < 1e-9) << std::endl;
    }
}

int
main()
{
  test_projection();
  test_surface();
  test_warning();

  const double pi = std::acos(-1.);
  run(box_complex({0., 0., 0.}, {1., 1., 1.}),
      {{"x < 0.5 + 1e-9", "z-max", .5, 1e-8},
       {"x < 1e-9", "", 1., 1e-12},
       {"x > .2 && y > .3 && x + y < 1.2 || sphere(.8,.8,1, .1)",
        "z-max",
        .7 * .7 / 2. + .01 * pi,
        1e-3}});
  run(box_complex({0., 0., 0.}, {1., 1., 1.}), {{"z > 1 - 1e-9", "", 1., 1e-12}});
  // A face in the plane of the condition, up to rounding; nothing is cut.
  geometry::SurfaceMesh corner;
  corner.points    = {{0., 0., 0.}, {.7, 0., 0.}, {0., 1.1, 0.}, {0., 0., .9}};
  corner.triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 2, 3}}};
  const double slope
    = .5 * std::sqrt(std::pow(1.1 * .9, 2) + std::pow(.7 * .9, 2) + std::pow(.7 * 1.1, 2));
  run(surface_complex(corner, "a corner"),
      {{"x/.7 + y/1.1 + z/.9 >= 1", "", slope, 1e-12},
       {"half_space(0,1.1,0, -1/.7,-1/1.1,-1/.9)", "", slope, 1e-12}});
  // The wall between the blocks, x = 1, is met by the borders.
  const std::vector<std::pair<Point<3>, Point<3>>> blocks{{{0., 0., 0.}, {1., 1., 1.}},
                                                          {{1., 0., 0.}, {2., 1., 1.}}};
  run(blocks_complex(BlockGrid(blocks), {1, 2}),
      {{"y < .35", "z-max", .7, 1e-12},
       {"sphere(1,.6,1, .2)", "", .04 * pi, 1e-3},
       {"x < 1 && z < .25", "y-min", .25, 1e-12}});
}
