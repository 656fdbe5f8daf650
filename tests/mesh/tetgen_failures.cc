// SPDX-License-Identifier: AGPL-3.0-or-later

// Everything that makes TetGen crash, loop or return nothing ends in one clear
// message, whether it is noticed before the call, by the child or by its parent.

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/expression.h"
#include "tetradapt/mesh/size_function.h"
#include "tetradapt/mesh/tetgen.h"
#include "tetradapt/mesh/tetgen_demand.h"
#include "tetradapt/mesh/tetgen_process.h"
#include "tetradapt/mesh/tetgen_request.h"

#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>

using namespace tetradapt;
using dealii::Point;
using mesh::PiecewiseLinearComplex;
using mesh::Sizing;
using scene::TetgenParameters;

namespace
{
  template <typename Action>
  void
  expect(const std::string &name, const Action &action)
  {
    std::cout << name << ": ";
    try
      {
        action();
        std::cout << "NO ERROR" << std::endl;
      }
    catch (const core::InputError &error)
      {
        std::cout << "input: " << error.what() << std::endl;
      }
    catch (const core::NumericalError &error)
      {
        std::cout << "numerical: " << error.what() << std::endl;
      }
  }

  const PiecewiseLinearComplex cube = mesh::box_complex(Point<3>(0, 0, 0), Point<3>(1, 1, 1));

  PiecewiseLinearComplex
  crossing_cubes()
  {
    auto plc = cube;
    for (const auto &p : cube.points)
      plc.points.emplace_back(.5 * p[0] + .7, .5 * p[1] + .2, .5 * p[2] + .3);
    for (auto facet : cube.facets)
      {
        for (unsigned int &v : facet.vertices)
          v += 8;
        plc.facets.push_back(facet);
      }
    plc.name = "crossing cubes";
    return plc;
  }

  void
  refuse_parameters()
  {
    const auto with = [](auto change) {
      return [=] {
        TetgenParameters parameters;
        change(parameters);
        mesh::Tetgen tetgen(parameters);
      };
    };
    expect("ratio 1", with([](auto &p) { p.radius_edge_ratio = 1.; }));
    expect("ratio nan", with([](auto &p) { p.radius_edge_ratio = std::nan(""); }));
    expect("angle 25", with([](auto &p) { p.dihedral_angle = 25.; }));
    expect("no time", with([](auto &p) { p.time_limit = 0.; }));
    expect("no memory", with([](auto &p) { p.memory_limit = -1.; }));
  }

  void
  refuse_boxes()
  {
    const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    expect("nan", [&] { mesh::box_complex(Point<3>(0, 0, 0), Point<3>(1, nan, 1)); });
    expect("infinite", [&] { mesh::box_complex(Point<3>(0, 0, 0), Point<3>(1, inf, 1)); });
    expect("empty", [] { mesh::box_complex(Point<3>(0, 0, 0), Point<3>(1, 1, 0)); });
    expect("inverted", [] { mesh::box_complex(Point<3>(0, 0, 0), Point<3>(1, -1, 1)); });
    expect("flat", [] { mesh::box_complex(Point<3>(0, 0, 0), Point<3>(1, 1, 1e-4)); });
    // As large as its distance from the origin is precise.
    const auto far = [](const double x, const double edge) {
      return [=] {
        const Point<3> lower(x, 0, 0);
        mesh::box_complex(lower, lower + Point<3>(edge, edge, edge));
      };
    };
    expect("far", far(4e15, 2.));
    expect("far, the other way", far(-4e15, 2.));
    expect("far, but large", far(4e15, 2e15));
    expect("large", far(0., 1e15));
  }

  /** Bodies so thin that tetrahedra of a good shape are too many, whatever is wanted. */
  void
  refuse_thin_bodies()
  {
    const auto plate = [](const double width, const double thickness, const double seconds) {
      return [=] {
        TetgenParameters parameters;
        parameters.time_limit = seconds;
        mesh::Tetgen(parameters)
          .mesh(mesh::box_complex(Point<3>(0, 0, 0), Point<3>(width, width, thickness)), Sizing());
      };
    };
    expect("1000 times wider than thick", plate(3000., 3., 600.));
    expect("the same, little time", plate(3., .006, 20.));
    // What the estimate says is what TetGen makes.
    for (const double ratio : {20., 50.})
      {
        const double thickness = 3. / ratio, area = 2. * 9. + 4. * 3. * thickness;
        const double n
          = mesh::Tetgen(TetgenParameters())
              .mesh(mesh::box_complex(Point<3>(0, 0, 0), Point<3>(3., 3., thickness)), Sizing())
              .n_cells();
        const double estimate = mesh::least_cells(9. * thickness, area);
        std::cout << "ratio " << ratio << ": within 30 % "
                  << (n > .7 * estimate && n < 1.3 * estimate) << std::endl;
      }
  }

  /** What the screening finds before TetGen is called. */
  void
  refuse_boundaries()
  {
    const mesh::Tetgen tetgen{TetgenParameters()};
    const auto         with = [&](auto change) {
      return [=, &tetgen] {
        auto plc = cube;
        change(plc);
        tetgen.mesh(plc, Sizing());
      };
    };
    expect("crossing", [&] { tetgen.mesh(crossing_cubes(), Sizing()); });
    expect("open", with([](auto &plc) { plc.facets.pop_back(); }));
    expect("wrong number", with([](auto &plc) { plc.facets[2].vertices[1] = 8; }));
    expect("nan", with([](auto &plc) { plc.points[5][2] = std::nan(""); }));
    expect("points twice", with([](auto &plc) {
             plc.points.push_back(plc.points[6]);
             plc.facets[3].vertices[1] = 8;
           }));
    expect("collapsed", with([](auto &plc) { plc.points[1] = plc.points[0]; }));
    expect("seed twice", with([](auto &plc) {
             plc.regions = {{Point<3>(.5, .5, .5), 1}, {Point<3>(.2, .5, .5), 2}};
           }));
    expect("seeds in one part only", [&] {
      auto plc = mesh::box_complex(Point<3>(0, 0, 0), Point<3>(1, 1, 1));
      for (const auto &p : cube.points)
        plc.points.emplace_back(p[0] + 2., p[1], p[2]);
      for (auto facet : cube.facets)
        {
          for (unsigned int &v : facet.vertices)
            v += 8;
          plc.facets.push_back(facet);
        }
      plc.name    = "two cubes";
      plc.regions = {{Point<3>(.5, .5, .5), 1}, {Point<3>(.2, .5, .5), 2}};
      tetgen.mesh(plc, Sizing());
    });
    expect("seed outside", with([](auto &plc) { plc.regions = {{Point<3>(5, 5, 5), 1}}; }));
  }

  void
  refuse_sizes()
  {
    TetgenParameters parameters;
    parameters.memory_limit = 64;
    const mesh::Tetgen tetgen(parameters);
    const auto         box  = tetgen.mesh(cube, Sizing());
    const auto         with = [&](auto change) {
      return [=, &tetgen, &box] {
        Sizing sizing;
        change(sizing);
        tetgen.refine(box, sizing);
      };
    };
    expect("tiny volume", with([](auto &s) { s.max_volume = 1e-12; }));
    expect("tiny volume of a new mesh", [&] { tetgen.mesh(cube, {1e-12, {}, {}}); });
    expect("tiny size", with([&](auto &s) { s.node_sizes.assign(box.n_points(), 1e-4); }));
    expect("no size", with([&](auto &s) { s.node_sizes.assign(box.n_points(), 0.); }));
    expect("sizes missing", with([](auto &s) { s.node_sizes.assign(3, 1.); }));
    expect("bounds missing", with([](auto &s) { s.cell_volumes.assign(3, 1.); }));
    expect("bound nan", with([](auto &s) { s.max_volume = std::nan(""); }));
    expect("negative function",
           [&] { mesh::mesh_with_size(tetgen, box, core::Expression("x - 0.5", "Mesh/Size")); });
  }

  /** What gets past the screening, or would. */
  void
  fail_in_child()
  {
    const auto run
      = [](PiecewiseLinearComplex plc, const std::string &switches, double time, double memory) {
          auto request     = mesh::make_request(plc, Sizing());
          request.switches = switches;
          mesh::run_tetgen(request, {time, memory}, plc.name);
        };
    auto broken         = cube;
    broken.points[0][0] = std::nan("");
    expect("nan", [&] { run(broken, "pqQ", 60, 1000); });
    broken                       = cube;
    broken.facets[0].vertices[0] = 17;
    expect("number", [&] { run(broken, "pqQ", 60, 1000); });
    expect("crossing", [&] { run(crossing_cubes(), "pqQ", 60, 1000); });
    expect("endless", [&] { run(cube, "pq0.7a0.01Q", 0.2, 1000); });
    expect("no time", [&] { run(cube, "pqQ", 1e-3, 1000); });
    expect("no memory", [&] { run(cube, "pqa0.000001Q", 60, 20); });
    expect("hardly any memory", [&] { run(cube, "pqQ", 60, 1); });
  }

  /** Other programs in the worker's place. */
  void
  fail_in_parent()
  {
    const auto run = [](const std::string &name) {
      expect(name, [&] {
        setenv("TETRADAPT_TETGEN_WORKER", ("./" + name).c_str(), 1);
        mesh::Tetgen{TetgenParameters()}.mesh(cube, Sizing());
      });
    };
    const auto script = [&](const std::string &name, const std::string &commands) {
      std::ofstream(name) << "#!/bin/sh\n" << commands << '\n';
      chmod(name.c_str(), 0755);
      run(name);
    };
    run("missing");
    script("segfault", "ulimit -c 0; kill -SEGV $$");
    script("abort", "ulimit -c 0; echo first >&2; echo Assertion failed >&2; kill -ABRT $$");
    script("killed", "kill -KILL $$");
    script("ended", "kill -TERM $$");
    script("no_instruction", "ulimit -c 0; kill -ILL $$");
    script("user_signal", "kill -USR1 $$");
    script("processor_time", "kill -XCPU $$");
    script("silent", "exit 0");
    script("babble", "echo hello; cat > /dev/null");
    script("zeros", "head -c 4096 /dev/zero");
    std::ofstream("no_program") << "nothing to run";
    chmod("no_program", 0755);
    run("no_program");
  }
} // namespace

int
main()
{
  refuse_parameters();
  refuse_boxes();
  refuse_thin_bodies();
  refuse_boundaries();
  refuse_sizes();
  fail_in_child();
  fail_in_parent();
}
