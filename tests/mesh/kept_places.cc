// SPDX-License-Identifier: AGPL-3.0-or-later
// Points and lines on the surface of a body and inside it have vertices and edges in its first
// mesh, in refined ones, in those that are cut into eight, in those that are made from scratch
// with coarser cells, and where the boundary is projected. What does not fit is refused.

#include "tetradapt/mesh/kept_places.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/surface_io.h"
#include "tetradapt/io/mesh_source.h"
#include "tetradapt/mesh/blocks.h"
#include "tetradapt/mesh/body_complex.h"
#include "tetradapt/mesh/boundary_projection.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/red_refinement.h"
#include "tetradapt/mesh/selection_cuts.h"
#include "tetradapt/mesh/tetgen.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>

using namespace tetradapt;
using namespace tetradapt::mesh;

KeptPlace
point(const std::string &name, const Point<3> &p)
{
  return {name, {p}};
}

KeptPlace
line(const std::string &name, const Point<3> &a, const Point<3> &b)
{
  return {name, {a, b}};
}

/** Whether all places have vertices where they are wanted, and lines edges all the way. */
void
check(const std::string &what, const TetMesh &mesh, const std::vector<KeptPlace> &places)
{
  for (const KeptPlace &wanted : places)
    {
      const KeptPlace *kept = find_place(mesh, wanted.name);
      if (kept == nullptr)
        {
          std::cout << "  " << what << ": " << wanted.name << " is LOST" << std::endl;
          continue;
        }
      const auto vertices = vertices_of(mesh, *kept); // throws
      double     distance = 0., length = 0.;
      for (std::size_t i = 0; i < wanted.ends.size(); ++i)
        distance = std::max(distance,
                            mesh.points[i == 0 ? vertices.front() : vertices.back()].distance(
                              wanted.ends[i]));
      for (std::size_t i = 1; i < vertices.size(); ++i)
        length += mesh.points[vertices[i]].distance(mesh.points[vertices[i - 1]]);
      const double right = wanted.ends.front().distance(wanted.ends.back());
      if (distance > 1e-6 || std::abs(length - right) > 1e-6)
        std::cout << "  " << what << ": " << wanted.name << " is WRONG by " << distance
                  << ", length " << length << std::endl;
    }
  std::cout << "  " << what << ": seen" << std::endl;
}

/** Everything that is made from a first mesh. */
void
check_later(const TetMesh &first, const std::vector<KeptPlace> &places)
{
  const Tetgen tetgen{scene::TetgenParameters()};
  check("first", first, places);
  Sizing fine;
  fine.max_volume       = .003;
  const TetMesh refined = tetgen.refine(first, fine);
  check("refined", refined, places);
  check("cut into eight", red_refine(first, nullptr), places);
  for (const double size : {.5, .12})
    {
      const BodyComplex body = body_complex(refined,
                                            std::vector<double>(refined.n_points(), size),
                                            build_edges(refined));
      const TetMesh     anew = tetgen.mesh(body.plc, body.sizing);
      check("from scratch", anew, places);
      std::cout << "  coarser: " << (anew.n_cells() < refined.n_cells() ? "yes" : "no")
                << ", volume "
                << (std::abs(total_volume(anew) - total_volume(first)) < 1e-9 * total_volume(first)
                      ? "right"
                      : "WRONG")
                << std::endl;
      check("and refined", tetgen.refine(anew, fine), places);
    }
}

void
run(const PiecewiseLinearComplex &plc, const std::vector<KeptPlace> &places)
{
  std::cout << plc.name << std::endl;
  Sizing coarse;
  coarse.max_volume = .05;
  check_later(Tetgen(scene::TetgenParameters()).mesh(with_kept_places(plc, places), coarse),
              places);
}

template <typename Action>
void
refused(const Action &action)
{
  try
    {
      action();
      std::cout << "NOT refused" << std::endl;
    }
  catch (const core::InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}

/** An octahedron whose triangles were cut into four twice, its points on the unit sphere. */
geometry::SurfaceMesh
sphere()
{
  geometry::SurfaceMesh surface;
  surface.points
    = {{1., 0., 0.}, {-1., 0., 0.}, {0., 1., 0.}, {0., -1., 0.}, {0., 0., 1.}, {0., 0., -1.}};
  for (unsigned int i = 0; i < 8; ++i)
    {
      const unsigned int x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2);
      if ((x + y + z) % 2 == 0)
        surface.triangles.push_back({{x, y, z}});
      else
        surface.triangles.push_back({{y, x, z}});
    }
  for (unsigned int level = 0; level < 2; ++level)
    {
      const auto coarse = surface.triangles;
      surface.triangles.clear();
      const auto middle = [&](const unsigned int a, const unsigned int b) {
        Tensor<1, 3> m = surface.points[a] + Tensor<1, 3>(surface.points[b]);
        m /= m.norm();
        const Point<3> p(m);
        for (unsigned int i = 0; i < surface.points.size(); ++i)
          if (surface.points[i].distance(p) < 1e-9)
            return i;
        surface.points.push_back(p);
        return static_cast<unsigned int>(surface.points.size() - 1);
      };
      for (const auto &t : coarse)
        {
          const unsigned int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
          surface.triangles.push_back({{t[0], a, c}});
          surface.triangles.push_back({{a, t[1], b}});
          surface.triangles.push_back({{c, b, t[2]}});
          surface.triangles.push_back({{a, b, c}});
        }
    }
  return surface;
}

void
projected()
{
  std::cout << "sphere, projected" << std::endl;
  const std::string file = "kept_sphere.off";
  {
    const auto    surface = sphere();
    std::ofstream out(file);
    out.precision(17);
    out << "OFF\n" << surface.points.size() << ' ' << surface.triangles.size() << " 0\n";
    for (const auto &p : surface.points)
      out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    for (const auto &t : surface.triangles)
      out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  }
  scene::Scene scene;
  scene.mesh.source               = scene::MeshSource::surface;
  scene.mesh.files                = {file};
  scene.mesh.volume_bounds        = {.05};
  scene.mesh.projection           = scene::MeshParameters::Projection::expression;
  scene.mesh.projection_functions = {"x^2 + y^2 + z^2 - 1"};
  scene.supports.resize(4);
  const double           where[4][3] = {{.48, .6, .64}, {1., 0., 0.}, {.1, .2, .3}, {0., .6, -.8}};
  std::vector<KeptPlace> places;
  for (unsigned int i = 0; i < 4; ++i)
    {
      scene.supports[i].name        = std::to_string(i);
      scene.supports[i].place.point = Point<3>(where[i][0], where[i][1], where[i][2]);
      places.push_back(point("Supports/" + std::to_string(i), *scene.supports[i].place.point));
    }
  const core::Log silent;
  TetMesh         mesh = io::make_mesh(scene, 0, silent);
  check("first", mesh, places);
  const auto   projection = make_projection(scene);
  const Tetgen tetgen(quality_for_projection(scene.tetgen, true));
  for (unsigned int level = 0; level < 2; ++level)
    {
      Sizing fine;
      fine.max_volume = level == 0 ? .02 : .004;
      mesh            = tetgen.refine(mesh, fine);
      projection->project(mesh);
      check("refined", mesh, places);
    }
  const BodyComplex body
    = body_complex(mesh, std::vector<double>(mesh.n_points(), .4), build_edges(mesh));
  TetMesh anew = tetgen.mesh(body.plc, body.sizing);
  projection->project(anew);
  check("from scratch", anew, places);
  TetMesh eight = red_refine(anew, nullptr);
  projection->project(eight);
  check("cut into eight", eight, places);

  scene.supports.resize(1);
  scene.supports[0].place.point = Point<3>(.5, .55, .6);
  refused([&]() { io::make_mesh(scene, 0, silent); });
  std::remove(file.c_str());
}

int
main()
{
  run(box_complex({0., 0., 0.}, {2., 1., 1.}),
      {point("Supports/corner", {2., 0., 1.}),
       point("Supports/edge", {.7, 0., 1.}),
       point("Loads/face", {1.3, .4, 1.}),
       point("Loads/near an edge", {.3, 1e-7, 1.}),
       point("Loads/inside", {.9, .45, .52}),
       line("Supports/across", {.55, 0., 1.}, {.55, 1., 1.}),
       line("Supports/along an edge", {.2, 1., 0.}, {1.4, 1., 0.}),
       line("Supports/in a face", {.3, .2, 0.}, {1.7, .8, 0.}),
       line("Supports/crosses that", {.9, .1, 0.}, {1.1, .9, 0.})});
  run(box_complex({0., 0., 0.}, {2., 1., 1.}),
      {line("Supports/inside", {.3, .3, .3}, {1.6, .7, .6}),
       line("Supports/through", {.5, 0., .5}, {.5, 1., .5}),
       line("Supports/crosses that", {.2, .5, .5}, {.8, .5, .5}),
       point("Loads/on that", {.5, .25, .5})});
  run(blocks_complex(BlockGrid({{{0., 0., 0.}, {1., 1., 1.}}, {{1., 0., 0.}, {2., 1., 1.}}}),
                     {1, 2}),
      {point("Loads/wall", {1., .3, .4}),
       line("Supports/through the wall", {.4, .5, .5}, {1.6, .5, .6}),
       line("Supports/in the wall", {1., .2, .2}, {1., .8, .7})});
  run(surface_complex(sphere(), "sphere"),
      {point("Loads/inside", {.1, .2, -.3}),
       line("Supports/diameter", {-1., 0., 0.}, {1., 0., 0.})});
  run(blocks_complex(BlockGrid({{{0., 0., 0.}, {1., 1., 2.}}, {{1., 0., 0.}, {2., 1., 1.}}}), {}),
      {line("Supports/past the re-entrant edge", {.5, .5, 1.5}, {1.5, .5, .5})});
  projected();

  std::cout << "refusals" << std::endl;
  const auto box = box_complex({0., 0., 0.}, {2., 1., 1.});
  refused([&]() { with_kept_places(box, {point("Loads/a", {2.5, .5, .5})}); });
  refused([&]() { with_kept_places(box, {line("Supports/a", {.5, .5, .5}, {.5, .5, 1.2})}); });
  const auto l_shape
    = blocks_complex(BlockGrid({{{0., 0., 0.}, {1., 1., 2.}}, {{1., 0., 0.}, {2., 1., 1.}}}), {});
  refused([&]() { with_kept_places(l_shape, {line("Supports/b", {.5, .5, 1.9}, {1.9, .5, .5})}); });
  const auto body = bricks({0., 0., 0.}, {2., 1., 1.}, {{4, 2, 2}});
  refused([&]() { places_on_vertices(body, {point("Loads/a", {.5, .5, .75})}); });
  refused([&]() { places_on_vertices(body, {line("Supports/a", {0., 0., 0.}, {1., .5, 0.})}); });
  const auto found
    = places_on_vertices(body, {line("Supports/a", {0., .5, 1.}, {2., .5, 1. + 1e-7})});
  std::cout << "bricks: " << vertices_of(body, found.front()).size() << " vertices" << std::endl;
}
