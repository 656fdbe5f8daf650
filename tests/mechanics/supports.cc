// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which nodes supports hold, to which values, and the bodies that they do not hold.

#include "tetradapt/mechanics/supports.h"

#include "tetradapt/core/expression.h"

#include "bodies.h"

#include <bitset>
#include <map>

using namespace bodies;

namespace
{
  /** Prescribes on a copy of @p body; degree 2 if @p quadratic. */
  mechanics::PrescribedDisplacement
  prescribe(mesh::TetMesh                                body,
            const std::vector<scene::SupportParameters> &supports,
            bool                                         quadratic)
  {
    scene::Scene scene;
    scene.supports = supports;
    select(body, scene);
    const mesh::EdgeTable edges = mesh::build_edges(body);
    return mechanics::prescribe(supports, body, quadratic ? &edges : nullptr);
  }

  /** A curved displacement on x = 0, and the z component alone on z = 0. */
  void
  values(const unsigned int degree)
  {
    std::cout << "degree " << degree << '\n';
    const auto                           body = box(Point<3>(2, 1, 1), {{3, 2, 2}});
    const Texts                          given{{"y*z", "1 + z^2", "sin(x)"}};
    const auto                           prescribed = prescribe(*body,
                                      {support("wall", "x < 1e-9", "xyz", given),
                                                                 support("floor", "z < 1e-9", "z", {{"0", "0", "sin(x)"}})},
                                      degree == 2);
    const mesh::NodalField               field(body, degree);
    const core::VectorExpression         exact(given, "test");
    std::map<unsigned int, unsigned int> counts;
    double                               error = 0.;
    for (unsigned int node = 0; node < field.n_nodes(); ++node)
      {
        ++counts[prescribed.fixed[node]];
        const auto x    = field.node_position(node);
        const auto wall = exact(x);
        for (unsigned int c = 0; c < 3; ++c)
          {
            const bool   fixed = x[0] < 1e-9 || (c == 2 && x[2] < 1e-9);
            const double value = fixed ? wall[c] : 0.;
            if (fixed != prescribed.is_fixed(node, c))
              error = 1e300;
            error = std::max(error, std::abs(prescribed.values[node][c] - value));
          }
      }
    for (const auto &entry : counts)
      std::cout << "  nodes with components zyx = " << std::bitset<3>(entry.first)
                << " fixed: " << entry.second << '\n';
    check("  values at their nodes", error, 0., 1., 1e-14);
    check("  not all zero", !prescribed.is_homogeneous());
    check("  all zero",
          prescribe(*body, {support("wall", "x < 1e-9")}, degree == 2).is_homogeneous());
  }

  /** Two unit cubes that share the edge x = y = 1. */
  mesh::TetMesh
  cubes_on_an_edge()
  {
    auto                      body   = mesh::bricks(Point<3>(), Point<3>(1, 1, 1), {{1, 1, 1}});
    const auto                second = body;
    std::vector<unsigned int> number;
    for (const auto &p : second.points)
      {
        const Point<3> q(p[0] + 1., p[1] + 1., p[2]);
        unsigned int   same = 0;
        while (same < body.n_points() && body.points[same].distance(q) > 1e-9)
          ++same;
        if (same == body.n_points())
          body.points.push_back(q);
        number.push_back(same);
      }
    for (auto cell : second.cells)
      {
        for (auto &p : cell)
          p = number[p];
        body.cells.push_back(cell);
        body.regions.push_back(0);
      }
    for (auto face : second.faces)
      {
        for (auto &p : face.vertices)
          p = number[p];
        body.faces.push_back(face);
      }
    mesh::finalize(body, "two cubes");
    return body;
  }

  /** Two unit cubes with a gap between 1 < x < 2. */
  mesh::TetMesh
  separate_cubes()
  {
    auto               body   = mesh::bricks(Point<3>(), Point<3>(1, 1, 1), {{1, 1, 1}});
    const auto         second = mesh::bricks(Point<3>(2, 0, 0), Point<3>(3, 1, 1), {{1, 1, 1}});
    const unsigned int n      = body.n_points();
    body.points.insert(body.points.end(), second.points.begin(), second.points.end());
    for (auto cell : second.cells)
      {
        for (auto &p : cell)
          p += n;
        body.cells.push_back(cell);
        body.regions.push_back(0);
      }
    for (auto face : second.faces)
      {
        for (auto &p : face.vertices)
          p += n;
        body.faces.push_back(face);
      }
    return body;
  }

  void
  refusals()
  {
    const auto cube = *box(Point<3>(1, 1, 1), {{2, 2, 2}});
    const auto left = support("left", "x < 1e-9"),
               lift = support("lift", "y < 1e-9", "z", {{"0", "0", "0.1*x + 0.1"}});
    for (const bool quadratic : {false, true})
      print_refusal("contradiction", [&] { prescribe(cube, {left, lift}, quadratic); });
    const auto roll = support("roll", "y < 1e-9", "z", {{"0", "0", "0.1*x"}});
    check("agreement where faces meet", prescribe(cube, {left, roll}, true).is_fixed(0, 2));

    print_refusal("free along z",
                  [&] { prescribe(cube, {support("left", "x < 1e-9", "xy")}, false); });
    print_refusal("free along y", [&] {
      prescribe(cube, {support("a", "z < 1e-9", "z"), support("b", "x < 1e-9", "x")}, false);
    });
    print_refusal("hinge on the z axis", [&] {
      prescribe(cube,
                {support("a", "x < 1e-9", "y"),
                 support("b", "y < 1e-9", "x"),
                 support("c", "z < 1e-9", "z")},
                true);
    });
    check("no hinge with one more component",
          !prescribe(cube,
                     {support("a", "x < 1e-9", "y"),
                      support("b", "y < 1e-9", "x"),
                      support("c", "z < 1e-9", "xz")},
                     false)
             .fixed.empty());
    print_refusal("hinge between parts", [&] {
      prescribe(cubes_on_an_edge(), {support("a", "abs(y - 1) < 1e-9 && x < 1 + 1e-9")}, false);
    });
    print_refusal("loose part", [&] { prescribe(separate_cubes(), {left}, true); });
    print_refusal("sliding part", [&] {
      prescribe(separate_cubes(), {left, support("right", "x > 3 - 1e-9", "xz")}, false);
    });
    check(
      "both parts held",
      !prescribe(separate_cubes(), {left, support("right", "x > 3 - 1e-9")}, false).fixed.empty());
    // The check must not depend on the unit of length or the place.
    for (const double size : {1e-6, 1e6})
      {
        auto far = cube;
        for (auto &p : far.points)
          p = size * (p + Tensor<1, 3>({100., 0., 0.}));
        check("held at size " + std::to_string(size),
              !prescribe(far, {support("left", "x/" + std::to_string(size) + " < 100.0001")}, false)
                 .fixed.empty());
      }
  }
} // namespace

int
main()
{
  values(1);
  values(2);
  refusals();
}
