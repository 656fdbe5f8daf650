// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Problems whose exact solution the elements can represent: on an irregular mesh
// the finite element solution must be it, to rounding.

#include "tetradapt/core/expression.h"

#include "solving.h"

#include <deal.II/base/mpi.h>

using namespace bodies;
using scene::LoadType;

namespace
{
  /** Largest distance of the nodal values from the exact ones over the largest of these. */
  double
  error(const mesh::NodalField &field, const Texts &exact)
  {
    const core::VectorExpression u(exact, "test");
    double                       largest = 0., scale = 0.;
    for (unsigned int node = 0; node < field.n_nodes(); ++node)
      {
        const Tensor<1, 3> value = u(field.node_position(node));
        largest                  = std::max(largest, (field.values[node] - value).norm());
        scale                    = std::max(scale, value.norm());
      }
    return largest / scale;
  }

  /** Largest stress in the cells' vertices, thermal strain taken off. */
  double
  largest_stress(const mesh::NodalField &field, const mechanics::MaterialMap &materials)
  {
    const auto &body    = field.mesh();
    double      largest = 0.;
    for (unsigned int cell = 0; cell < body.n_cells(); ++cell)
      for (unsigned int i = 0; i < 4; ++i)
        {
          mesh::Barycentric b{};
          b[i]                = 1.;
          const int    region = body.regions[cell];
          Tensor<2, 3> G      = field.gradient(cell, b);
          G -= Tensor<2, 3>(materials.thermal_strain(region, body.points[body.cells[cell][i]]));
          largest = std::max(largest, materials.linear_law(region).stress(G).norm());
        }
    return largest;
  }

  /** A body, what is done to it and what must become of it. */
  struct Problem
  {
    explicit Problem(const std::string &name) : name(name)
    {
      scene.materials = {material("m", 1000., 0.3)};
    }
    std::string                    name;
    scene::Scene                   scene;
    std::shared_ptr<mesh::TetMesh> body = box(Point<3>(2, 1, 1), {{4, 4, 3}});
    Texts                          displacement;
    double                         stored_energy = 0.;
    std::vector<unsigned int>      degrees{1, 2};
    double no_stress = 0.; ///< if positive: there is none compared with this
  };

  void
  run(Problem problem)
  {
    problem.scene.solver.tolerance = 1e-14;
    for (const unsigned int degree : problem.degrees)
      for (const SolverType type : {SolverType::direct, SolverType::cg})
        {
          problem.scene.solver.type = type;
          const auto result         = solve_scene(problem.scene, problem.body, degree);
          check(problem.name + ", P" + std::to_string(degree)
                  + (type == SolverType::cg ? ", iterative" : ", direct"),
                error(*result.whole, problem.displacement),
                0.,
                1.,
                1e-12);
          check("  stored energy",
                result.strain_energy,
                problem.stored_energy,
                std::max(problem.stored_energy, 1e-6),
                1e-11);
          if (problem.no_stress > 0.)
            {
              const mechanics::MaterialMap materials(problem.scene, *problem.body);
              check(
                "  stress", largest_stress(*result.whole, materials), 0., problem.no_stress, 1e-10);
            }
        }
  }

  /** Rollers on the three sides through the origin. */
  std::vector<scene::SupportParameters>
  rollers()
  {
    return {support("a", "x < 1e-9", "x"),
            support("b", "y < 1e-9", "y"),
            support("c", "z < 1e-9", "z")};
  }

  void
  patch_tests()
  {
    const double mu = 1000. / 2.6; // shear modulus
    {
      Problem p("linear");
      p.displacement   = {{"0.1 + 0.2*x - 0.1*y + 0.3*z", "0.3*x + 0.1*y", "0.2*y - 0.3*z"}};
      p.scene.supports = {support("all", "1", "xyz", p.displacement)};
      // Strain: 0.2, 0.1, -0.3 on the diagonal (trace 0), 0.1, 0.15, 0.1 beside it.
      p.stored_energy = 2. * mu * (0.04 + 0.01 + 0.09 + 2. * (0.01 + 0.0225 + 0.01));
      run(p);
    }
    {
      Problem p("rigid motion");
      p.displacement   = {{"1 - 0.3*y + 0.2*z", "2 + 0.3*x - 0.1*z", "3 - 0.2*x + 0.1*y"}};
      p.scene.supports = {support("all", "1", "xyz", p.displacement)};
      run(p);
      p.name           = "rigid motion of one side";
      p.scene.supports = {support("side", "x < 1e-9", "xyz", p.displacement)};
      p.no_stress      = 1000.;
      run(p);
    }
    {
      // The gradient of the harmonic x y z: strain z, y, x beside the diagonal.
      Problem p("quadratic");
      p.displacement   = {{"y*z", "x*z", "x*y"}};
      p.scene.supports = {support("all", "1", "xyz", p.displacement)};
      p.stored_energy  = mu * 2. * (8. / 3. + 2. / 3. + 2. / 3.);
      p.degrees        = {2};
      run(p);
    }
  }

  void
  bars()
  {
    {
      Problem p("pulled bar");
      p.scene.supports = rollers();
      p.scene.loads    = {load("end", LoadType::traction, "x > 2-1e-9", {{"10", "0", "0"}})};
      p.displacement   = {{"0.01*x", "-0.003*y", "-0.003*z"}};
      p.stored_energy  = 0.5 * 10. * 0.01 * 2.;
      run(p);
    }
    {
      // nu/E is the same in both halves, so that these contract alike.
      Problem p("two bars in a row");
      p.scene.materials            = {material("left", 1000., 0.3), material("right", 500., 0.15)};
      p.scene.materials[1].regions = {1};
      p.body                       = box(Point<3>(2, 1, 1), {{4, 4, 3}}, 0.2, 1.);
      p.scene.supports             = rollers();
      p.scene.loads   = {load("end", LoadType::traction, "x > 2-1e-9", {{"10", "0", "0"}})};
      p.displacement  = {{"if(x < 1, 0.01*x, 0.01 + 0.02*(x-1))", "-0.003*y", "-0.003*z"}};
      p.stored_energy = 0.5 * 10. * (0.01 + 0.02);
      run(p);
    }
    {
      Problem p("under pressure");
      p.scene.supports = rollers();
      p.scene.loads
        = {load("water", LoadType::pressure, "max(max(x/2, y), z) > 1-1e-9", {{"50", "", ""}})};
      p.displacement  = {{"-0.02*x", "-0.02*y", "-0.02*z"}}; // p (1 - 2 nu) / E
      p.stored_energy = 0.5 * 50. * 0.06 * 2.;
      run(p);
    }
    {
      // Stress b (2 - x) along x from a body force b = 5; the sections bulge.
      Problem p("hanging bar");
      p.displacement               = {{"0.005 * (2*x - x^2/2 - 0.3*(y^2 + z^2)/2)",
                                       "-0.0015 * (2-x) * y",
                                       "-0.0015 * (2-x) * z"}};
      p.scene.supports             = {support("top", "x < 1e-9", "xyz", p.displacement)};
      p.scene.loads                = {load("weight", LoadType::gravity, "", {{"2.5", "0", "0"}})};
      p.scene.materials[0].density = 2.;
      p.stored_energy              = 25. / 2000. * 8. / 3.;
      p.degrees                    = {2};
      run(p);
    }
  }

  void
  heat()
  {
    {
      Problem p("warmed evenly");
      p.scene.materials[0].thermal_expansion = 1e-3;
      p.scene.supports                       = rollers();
      p.scene.loads  = {load("heat", LoadType::temperature, "", {{"20", "", ""}})};
      p.displacement = {{"0.02*x", "0.02*y", "0.02*z"}};
      p.no_stress    = 1000. * 0.02 / 0.4; // of the same heat in a body held all around
      run(p);
    }
    {
      // A temperature that is linear leaves a free body without stress, but curved.
      Problem p("warmed at one end");
      p.scene.materials[0].thermal_expansion = 1e-3;
      p.displacement   = {{"0.01 * (x^2 - y^2 - z^2)", "0.02*x*y", "0.02*x*z"}};
      p.scene.supports = {support("side", "x < 1e-9", "xyz", p.displacement)};
      p.scene.loads    = {load("heat", LoadType::temperature, "", {{"20*x", "", ""}})};
      p.no_stress      = 1000. * 0.02 / 0.4;
      p.degrees        = {2};
      run(p);
    }
    {
      // Nothing moves: all of the heat becomes pressure, and energy 9/2 K (alpha T)^2.
      Problem p("warmed and held");
      p.scene.materials[0].thermal_expansion = 1e-3;
      p.displacement                         = {{"1", "0", "0"}};
      p.scene.supports                       = {support("all", "1", "xyz", p.displacement)};
      p.scene.loads   = {load("heat", LoadType::temperature, "", {{"20", "", ""}})};
      p.stored_energy = 4.5 * (1000. / 1.2) * 0.0004 * 2.;
      run(p);
    }
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  patch_tests();
  bars();
  heat();
}
