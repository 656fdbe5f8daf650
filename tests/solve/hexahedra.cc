// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Hexahedra: exact for linear displacements, held where supports end, with the selections of the
// scene; on one, two and three ranks.

#include "tetradapt/io/mesh_source.h"
#include "tetradapt/solve/hexahedral_multigrid.h"

#include "solving.h"

#include <deal.II/base/function.h>
#include <deal.II/base/mpi.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>

using namespace bodies;
using scene::LoadType;

namespace
{
  bool first_rank = true;

  void
  say(const std::string &what, const bool holds)
  {
    if (first_rank)
      check(what, holds);
  }

  /** The scene's first mesh with its selections. */
  std::shared_ptr<mesh::TetMesh>
  mesh_of(const scene::Scene &scene)
  {
    return std::make_shared<mesh::TetMesh>(io::make_mesh(scene, 0, core::Log()));
  }

  scene::Scene
  l_shape()
  {
    scene::Scene scene;
    scene.mesh.source        = scene::MeshSource::blocks;
    scene.mesh.blocks        = {{Point<3>(0, 0, 0), Point<3>(1, 1, 1)},
                                {Point<3>(1, 0, 0), Point<3>(2, 1, 1)},
                                {Point<3>(0, 0, 1), Point<3>(1, 1, 2)}};
    scene.mesh.block_regions = {0, 1, 0};
    scene.materials          = {material("soft", 10., 0.3)};
    return scene;
  }

  /** A linear displacement with gradient G, or x_d x_(d+1). */
  class Polynomial : public dealii::Function<3>
  {
  public:
    Polynomial(const Tensor<2, 3> &G, const bool quadratic)
      : Function<3>(3), G(G), quadratic(quadratic)
    {
    }
    double
    value(const Point<3> &x, const unsigned int d) const override
    {
      return quadratic ? x[d] * x[(d + 1) % 3] : G[d] * x;
    }

  private:
    Tensor<2, 3> G;
    bool         quadratic;
  };

  /** On cells of three sizes: constant stress is in equilibrium at all inner nodes, and
   * the energy of a quadratic displacement is exact. */
  void
  test_patch(const unsigned int degree)
  {
    scene::Scene scene                = l_shape();
    scene.supports                    = {support("all", "")};
    const auto                   mesh = mesh_of(scene);
    const mechanics::MaterialMap materials(scene, *mesh);
    const auto                   grid = solve::make_hexahedral_grid(scene, *mesh, core::Log());
    solve::HexahedralForest      forest(grid, MPI_COMM_WORLD);
    for (const double radius : {9., 1.2, .5})
      {
        std::vector<bool> flags;
        for (const auto &cell : forest.cells())
          flags.push_back(cell.lower.distance(Point<3>(1, .5, .5)) < radius);
        forest.refine(flags);
      }
    const solve::HexahedralLevels levels(scene, materials, forest, degree);
    const solve::HexahedralLevel &level = levels.fine;
    const std::string             name  = "patch, degree " + std::to_string(degree) + ": ";

    Tensor<2, 3> G;
    for (unsigned int i = 0; i < 9; ++i)
      G[i / 3][i % 3] = .1 * (int(i * 7 % 5) - 2);
    const solve::Constraints &hanging_nodes = level.space.hanging_nodes();
    solve::Vector             u[2];
    for (const bool quadratic : {false, true})
      {
        u[quadratic].reinit(level.stiffness->vector_layout());
        dealii::VectorTools::interpolate(level.space.dof_handler(),
                                         Polynomial(G, quadratic),
                                         u[quadratic]);
      }
    solve::Vector hung(u[1]);
    hanging_nodes.set_zero(hung);
    hanging_nodes.distribute(hung);
    hung -= u[1];
    say(name + "some nodes hang",
        dealii::Utilities::MPI::max(hanging_nodes.n_constraints(), MPI_COMM_WORLD) > 0);
    say(name + "they hang right", hung.linfty_norm() < 1e-12);

    const auto   linear = level.stiffness->inner_forces(u[0]);
    const double exact  = 3. * materials.linear_law(0).energy_density(dealii::symmetrize(G));
    say(name + "equilibrium",
        linear.size > .01 && linear.on_free.linfty_norm() < 1e-13 * linear.size);
    say(name + "energy of constant strain", std::abs(linear.energy / exact - 1.) < 1e-12);

    // eps_dd = x_(d+1) and eps_(d,d+1) = x_d / 2, integrated over the three cubes.
    const double lambda = 10. * .3 / (1.3 * .4), mu = 10. / 2.6;
    const double squares[3] = {1. / 3. + 7. / 3. + 1. / 3., 1., 1. / 3. + 1. / 3. + 7. / 3.};
    const double products   = 2. * ((.25 + .75 + .25) + (.25 + .25 + .75) + (.25 + .75 + .75));
    const double sum        = squares[0] + squares[1] + squares[2];
    const double quadratic  = (lambda + 2. * mu) * sum + lambda * products + mu * sum;
    say(name + "energy of a quadratic displacement",
        std::abs(level.stiffness->inner_forces(u[1]).energy / quadratic - 1.) < 1e-12);
  }

  /** A support ends where a coarser cell begins: also the nodes that hang there are held, on
   * cells of three sizes, whatever the rest of the body does. */
  void
  test_border(const unsigned int degree)
  {
    scene::Scene scene = l_shape();
    scene.supports     = {support("floor", "z < 1e-9 && x < 1 + 1e-9", "xyz", {{"1", "x", "2*y"}})};
    const auto                   mesh = mesh_of(scene);
    const mechanics::MaterialMap materials(scene, *mesh);
    const auto                   grid = solve::make_hexahedral_grid(scene, *mesh, core::Log());
    solve::HexahedralForest      forest(grid, MPI_COMM_WORLD);
    for (const double end : {1., .9})
      {
        std::vector<bool> flags;
        for (const auto &cell : forest.cells())
          flags.push_back(cell.lower[0] < end - 1e-9 && cell.lower[2] < .4);
        forest.refine(flags);
      }
    const solve::HexahedralLevels levels(scene, materials, forest, degree);
    const solve::HexahedralLevel &level = levels.fine;
    solve::Vector                 u(level.space.dof_handler().locally_owned_dofs(),
                    level.constraints.get_local_lines(),
                    MPI_COMM_WORLD);
    for (const auto i : u.locally_owned_elements())
      u[i] = std::sin(1. + i);
    level.constraints.distribute(u);
    u.update_ghost_values();

    double                       worst   = 0.;
    unsigned int                 n_sides = 0, n_hanging = 0;
    solve::HexahedralSpace::Dofs dofs;
    for (unsigned int c = 0; c < forest.cells().size(); ++c)
      {
        const auto &cell = forest.cells()[c];
        if (cell.patches[4] == solve::HexahedralGrid::none || cell.lower[0] > 1. - 1e-9)
          continue;
        ++n_sides;
        level.space.get_dofs(c, dofs);
        for (unsigned int j = 0; j <= degree; ++j)
          for (unsigned int i = 0; i <= degree; ++i)
            {
              const double x        = cell.lower[0] + i * cell.size[0] / degree;
              const double y        = cell.lower[1] + j * cell.size[1] / degree;
              const double right[3] = {1., x, 2. * y};
              for (unsigned int k = 0; k < 3; ++k)
                {
                  const auto dof = dofs[3 * (j * (degree + 1) + i) + k];
                  n_hanging += level.space.hanging_nodes().is_constrained(dof) ? 1 : 0;
                  // Nodes of degree 3 are not equally spaced: their values are compared in x = 1.
                  if (degree == 2 || k == 0)
                    worst = std::max(worst, std::abs(u[dof] - right[k]));
                }
            }
      }
    const std::string name = "border of a support, degree " + std::to_string(degree) + ": ";
    say(name + "some of its nodes hang",
        dealii::Utilities::MPI::sum(n_hanging, MPI_COMM_WORLD) > 0
          && dealii::Utilities::MPI::sum(n_sides, MPI_COMM_WORLD) > 4);
    say(name + "all are held", dealii::Utilities::MPI::max(worst, MPI_COMM_WORLD) < 1e-12);
  }

  /** Cells know their bricks, and with these the sides of the body. */
  void
  test_bricks()
  {
    scene::Scene scene = l_shape();
    for (auto &block : scene.mesh.blocks)
      block.first[1] *= .5, block.second[1] *= .5;
    scene.supports               = {support("back", "x < 1e-9")};
    const auto              grid = solve::make_hexahedral_grid(scene, *mesh_of(scene), core::Log());
    solve::HexahedralForest forest(grid, MPI_COMM_WORLD);
    forest.refine(std::vector<bool>(forest.cells().size(), true));
    bool   inside = true;
    double area = 0., back = 0.;
    for (const auto &cell : forest.cells())
      {
        unsigned int brick = 0;
        for (unsigned int d = 3; d-- > 0;)
          brick = brick * grid.size(d)
                  + (std::upper_bound(grid.planes[d].begin(),
                                      grid.planes[d].end(),
                                      cell.lower[d] + .5 * cell.size[d])
                     - grid.planes[d].begin() - 1);
        inside
          = inside && cell.region == grid.regions[brick]
            && ((2. * cell.size) - (grid.corner(brick, 7) - grid.corner(brick, 0))).norm() < 1e-12;
        for (unsigned int side = 0; side < 6; ++side)
          if (cell.patches[side] != solve::HexahedralGrid::none)
            {
              const double part = cell.size[(side / 2 + 1) % 3] * cell.size[(side / 2 + 2) % 3];
              area += part;
              inside = inside && cell.patches[side] == grid.sides[brick][side];
              if (!grid.patches.at(cell.patches[side]).selections.empty())
                back += part;
            }
      }
    say("cells lie in their bricks", inside && grid.n_bricks() == 16);
    area = dealii::Utilities::MPI::sum(area, MPI_COMM_WORLD);
    back = dealii::Utilities::MPI::sum(back, MPI_COMM_WORLD);
    say("area of the body and of a selection",
        std::abs(area - 10.) < 1e-12 && std::abs(back - 1.) < 1e-12);
  }

  void
  test_selections()
  {
    scene::Scene scene;
    scene.mesh.upper_corner = Point<3>(2, 1, 1);
    scene.materials         = {material("m", 1., 0.3)};
    scene.supports          = {support("clamp", "x < 1e-9")};
    scene.loads = {load("half", LoadType::pressure, "z > 1-1e-9 && x < 0.7 && y > 0.25", {{"1"}})};
    core::Log    log;
    unsigned int n_warnings = 0;
    std::string  last_warning;
    log.add_sink([&](core::LogLevel level, const std::string &text) {
      if (level != core::LogLevel::warning)
        return;
      ++n_warnings;
      last_warning = text;
    });
    const auto grid = solve::make_hexahedral_grid(scene,
                                                  *mesh_of([&] {
                                                    auto fine      = scene;
                                                    fine.mesh.size = "0.2";
                                                    return fine;
                                                  }()),
                                                  log);
    double     area = 0.;
    for (unsigned int brick = 0; brick < grid.n_bricks(); ++brick)
      if (grid.sides[brick][5] != solve::HexahedralGrid::none
          && !grid.patches[grid.sides[brick][5]].selections.empty())
        area += (grid.corner(brick, 7)[0] - grid.corner(brick, 0)[0])
                * (grid.corner(brick, 7)[1] - grid.corner(brick, 0)[1]);
    if (!first_rank)
      return;
    check("planes where a selection ends: area", area, .7 * .75, 1., 1e-6);
    check("the border is cut into the tetrahedra: same area, no warning", n_warnings == 0);
    // Bricks cannot be cut: their triangles select other parts of the side than the hexahedra do.
    auto bricks         = scene;
    bricks.mesh.source  = scene::MeshSource::bricks;
    bricks.mesh.cells   = {{{4, 2, 2}}};
    const auto as_whole = mesh_of(bricks);
    n_warnings          = 0;
    solve::make_hexahedral_grid(bricks, *as_whole, log);
    check("bricks select whole triangles: one warning", n_warnings == 1);
    check("  that names the load, its area here and there",
          last_warning.find("Loads/half selects an area of 0.525 ") != std::string::npos
            && last_warning.find("but of 0.25 on the scene's first mesh") != std::string::npos);
    const auto refuse = [&](const std::string &what) {
      print_refusal(what, [&] {
        auto fine      = scene;
        fine.mesh.size = "0.2";
        solve::make_hexahedral_grid(scene, io::make_mesh(fine, 0, log), log);
      });
    };
    scene.loads[0].selector.where = "z > 1-1e-9 && x^2 + y^2 < 0.5";
    refuse("a disc");
    scene.loads[0].selector.where = "z > 1-1e-9";
    scene.loads[0].type           = LoadType::nodal_force;
    refuse("forces on nodes");
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  test_patch(2);
  test_patch(3);
  test_border(2);
  test_border(3);
  test_bricks();
  test_selections();
}
