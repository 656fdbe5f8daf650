// SPDX-License-Identifier: AGPL-3.0-or-later
// The estimators on fields for which their values are known by hand.

#include "tetradapt/compare/root_of_squares.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/estimate/extrapolation.h"
#include "tetradapt/estimate/flux_projection.h"
#include "tetradapt/estimate/interpolation.h"
#include "tetradapt/estimate/residual.h"
#include "tetradapt/fem/replication.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/mesh/selection.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <functional>
#include <iostream>

using namespace tetradapt;
using dealii::Point;
using dealii::Tensor;
using Field  = std::function<Tensor<1, 3>(const Point<3> &)>;
using Levels = std::vector<estimate::EnergyLevel>;

/** E = 1, nu = 0.25: lambda = mu = 0.4, lambda + 2 mu = 1.2. */
scene::MaterialParameters
material(const std::string &name, const double young_modulus)
{
  scene::MaterialParameters result;
  result.name                       = name;
  result.constants["Young modulus"] = young_modulus;
  result.constants["Poisson ratio"] = 0.25;
  return result;
}

/** A displacement on a mesh with a scene, and what estimators ask for. */
struct Case
{
  Case(const scene::Scene &scene, mesh::TetMesh tets, const unsigned int degree, const Field &u)
    : scene(scene)
  {
    std::vector<std::pair<std::string, scene::Selector>> selectors;
    for (const auto &support : scene.supports)
      selectors.emplace_back("Supports/" + support.name, support.selector);
    for (const auto &load : scene.loads)
      if (load.type != scene::LoadType::body_force)
        selectors.emplace_back("Loads/" + load.name, load.selector);
    mesh::select_faces(tets, selectors);
    mesh::NodalField field(std::make_shared<mesh::TetMesh>(std::move(tets)), degree);
    for (unsigned int i = 0; i < field.n_nodes(); ++i)
      field.values[i] = u(field.node_position(i));
    solution.displacement = fem::distribute(field, MPI_COMM_SELF);
    materials             = std::make_unique<mechanics::MaterialMap>(this->scene, field.mesh());
    comparison            = std::make_unique<estimate::Comparison>(
      solution.displacement, *materials, this->scene.exact_solution, reference, MPI_COMM_SELF);
  }

  /** A reference, given after construction. */
  void
  compare_with(std::shared_ptr<const mesh::NodalField> field)
  {
    reference
      = std::make_shared<compare::ReferenceSampling>(std::move(field), *materials, MPI_COMM_SELF);
    comparison = std::make_unique<estimate::Comparison>(
      solution.displacement, *materials, scene.exact_solution, reference, MPI_COMM_SELF);
  }

  estimate::Estimate
  estimate(const estimate::Estimator &estimator, const Levels &levels = {})
  {
    return estimator.estimate({*comparison, scene, solution, levels});
  }

  scene::Scene                                      scene;
  solve::StaticSolution                             solution;
  std::unique_ptr<mechanics::MaterialMap>           materials;
  std::shared_ptr<const compare::ReferenceSampling> reference;
  std::unique_ptr<estimate::Comparison>             comparison;
};

mesh::TetMesh
block(const unsigned int n)
{
  return mesh::bricks(Point<3>(0., 0., 0.), Point<3>(1., 1., 1.), {{n, n, n}});
}

/** A support of all components where @p where holds. */
scene::SupportParameters
clamp(const std::string &where)
{
  scene::SupportParameters support;
  support.name           = "clamp";
  support.selector.where = where;
  return support;
}

scene::LoadParameters
load(const std::string                &name,
     const scene::LoadType             type,
     const std::array<std::string, 3> &value,
     const std::string                &where = "")
{
  scene::LoadParameters result;
  result.name           = name;
  result.type           = type;
  result.value          = value;
  result.selector.where = where;
  return result;
}

double
sum_of(const std::vector<double> &values)
{
  double sum = 0.;
  for (const double v : values)
    sum += v;
  return sum;
}

template <typename Action>
void
expect_error(const Action &action)
{
  try
    {
      action();
      std::cout << "accepted\n";
    }
  catch (const core::InputError &error)
    {
      std::cout << "InputError: " << error.what() << '\n';
    }
}

/** The true displacement is a stretch by 0.02 along x, the solution nine tenths of it. */
void
differences()
{
  scene::Scene scene;
  scene.materials                   = {material("all", 1.)};
  scene.exact_solution.displacement = {{"0.02*x", "0", "0"}};
  scene.exact_solution.gradient     = {{"0.02", "0", "0", "0", "0", "0", "0", "0", "0"}};
  const auto stretch                = [](const double factor) {
    return [factor](const Point<3> &p) { return Tensor<1, 3>({factor * p[0], 0., 0.}); };
  };
  Case known(scene, mesh::bricks({0., 0., 0.}, {1., 1., 1.}, {{2, 2, 1}}), 1, stretch(0.018));
  expect_error([&] { known.estimate(estimate::ExtrapolationEnergy()); });
  Case finer(scene, mesh::bricks({0., 0., 0.}, {1., 1., 1.}, {{5, 3, 3}}), 2, stretch(0.02));
  known.compare_with(fem::replicate(*finer.solution.displacement));

  // A strain of 0.002 along x: energy 1.2 * 0.002^2.
  const double unit = 0.002 * std::sqrt(1.2);
  for (const estimate::Estimator *estimator :
       {static_cast<const estimate::Estimator *>(new estimate::ExtrapolationEnergy),
        static_cast<const estimate::Estimator *>(new estimate::ExactEnergy)})
    {
      const std::unique_ptr<const estimate::Estimator> owner(estimator);
      const auto                                       result = known.estimate(*estimator);
      std::cout << estimator->traits().name << ": global " << result.global / unit
                << ", root of squares " << compare::root_of_squares(result.indicators) / unit
                << '\n';
    }
  // Nodes at x = 0 do not move and count zero: 6 of 18.
  const auto ren = known.estimate(estimate::ExtrapolationRen());
  std::cout << "extrapolation ren: global " << ren.global / 0.1 << ", sum "
            << sum_of(ren.indicators) / 0.1 << '\n';
  std::cout << "computed once: "
            << (&known.comparison->to_reference() == &known.comparison->to_reference())
            << (&known.comparison->ren() == &known.comparison->ren())
            << ", exact solution before reference "
            << (&known.comparison->ren() != &known.comparison->ren_to_reference()) << '\n';
}

/** Where the solution is exact, with the loads and supports that belong to it. */
void
exact_solutions()
{
  scene::Scene scene;
  scene.materials = {material("all", 1.)};
  scene.supports  = {clamp("x < 1e-9")};
  // A strain of 1 along x: stresses 1.2, 0.4, 0.4.
  scene.supports[0].displacement = {{"x", "0", "0"}};
  scene.loads = {load("x", scene::LoadType::traction, {{"1.2", "0", "0"}}, "x > 1 - 1e-9"),
                 load("y0", scene::LoadType::traction, {{"0", "-0.4", "0"}}, "y < 1e-9"),
                 load("y1", scene::LoadType::traction, {{"0", "0.4", "0"}}, "y > 1 - 1e-9"),
                 load("z", scene::LoadType::pressure, {{"-0.4", "0", "0"}}, "abs(z-0.5) > 0.4999")};
  for (unsigned int degree = 1; degree <= 2; ++degree)
    {
      Case   exact(scene, block(3), degree, [](const Point<3> &p) {
        return Tensor<1, 3>({p[0], 0., 0.});
      });
      double largest = 0.;
      for (const double value : {exact.estimate(estimate::PatchRecovery()).global,
                                 exact.estimate(estimate::Averaging()).global,
                                 exact.estimate(estimate::Residual()).global,
                                 exact.estimate(estimate::Interpolation()).global})
        largest = std::max(largest, value);
      std::cout << "exact solution, degree " << degree << ": "
                << (largest < 1e-12 ? "no error" : "ERROR") << '\n';
      exact.scene.loads[3].value[0] = "0.4";
      std::cout << "wrong pressure, degree " << degree << ": "
                << (exact.estimate(estimate::PatchRecovery()).global > 0.1) << ' '
                << (exact.estimate(estimate::Averaging()).global > 0.1) << ' '
                << (exact.estimate(estimate::Residual()).global > 0.1) << '\n';
    }
}

/** The two tetrahedra with the points 0 0 0, 0 1 0, 0 0 1 in common, one on either side; all three
 * edges at 0 0 0 are 1 long. */
mesh::TetMesh
two_cells()
{
  mesh::TetMesh tets;
  tets.points  = {{0., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}, {-1., 0., 0.}, {1., 0., 0.}};
  tets.cells   = {{{0, 2, 1, 3}}, {{0, 1, 2, 4}}};
  tets.regions = {0, 1};
  mesh::finalize(tets, "two cells");
  return tets;
}

/** Terms of the residual estimator, one by one: V = 1/6; the heights over the faces of
 * area 1/2 are 1, their h A = 3 V = 1/2. */
void
residual_terms()
{
  scene::Scene scene;
  scene.materials = {material("left", 1.), material("right", 1e4)};
  for (int i = 0; i < 2; ++i)
    scene.materials[i].regions = {i};
  scene.supports = {clamp("")};

  // A jump of the strain along x by 1 next to soft matter at rest: the traction is 1.2e4,
  // the mean of 1.2 and 1.2e4 its modulus.
  Case         kink(scene, two_cells(), 1, [](const Point<3> &p) {
    return Tensor<1, 3>({std::max(p[0], 0.), 0., 0.});
  });
  const auto   jump     = kink.estimate(estimate::Residual());
  const double expected = 1. / 24. * 0.5 * 1.2e4 * 1.2e4 / (0.5 * (1.2 + 1.2e4));
  std::cout << "jump: " << jump.indicators[0] / std::sqrt(expected) << ' '
            << jump.indicators[1] / std::sqrt(expected) << '\n';

  // A body force at rest: h = 3 V over the mean area of the faces, mu = 0.4 and 4000.
  scene.loads      = {load("inside", scene::LoadType::body_force, {{"3", "0", "4"}})};
  const Field rest = [](const Point<3> &) { return Tensor<1, 3>(); };
  for (unsigned int degree = 1; degree <= 2; ++degree)
    {
      const auto   inside = Case(scene, two_cells(), degree, rest).estimate(estimate::Residual());
      const double h      = 0.5 / ((1.5 + 0.5 * std::sqrt(3.)) / 4.);
      std::cout << "body force, degree " << degree << ": "
                << inside.indicators[0] / std::sqrt(h * h / (24. * degree * 0.4) * 25. / 6.) << ' '
                << 100. * inside.indicators[1] / inside.indicators[0] << '\n';
    }

  // A traction at rest on the slanted face of the soft cell, normal or along it: the modulus
  // is lambda + 2 mu = 1.2 or mu = 0.4. It counts twice.
  scene.supports[0].selector.where = "y < 1e-9 || z < 1e-9 || x+y+z > 1-1e-9";
  for (const char *value : {"-1;1;1", "0;1;-1"})
    {
      const bool normal  = value[0] == '-';
      scene.loads        = {load("slanted",
                          scene::LoadType::traction,
                          normal ? std::array<std::string, 3>{{"-1", "1", "1"}}
                                        : std::array<std::string, 3>{{"0", "1", "-1"}},
                          "abs(y+z-x-1) < 1e-9")};
      const auto missing = Case(scene, two_cells(), 1, rest).estimate(estimate::Residual());
      std::cout << "traction: "
                << missing.indicators[0]
                     / std::sqrt(2. / 24. * 0.5 * (normal ? 3. / 1.2 : 2. / 0.4))
                << ' ' << missing.indicators[1] << '\n';
    }
}

/** The interpolant of a polynomial of degree p + 1, whose error is known exactly. */
void
interpolation_errors()
{
  const std::array<std::string, 3> texts[2]
    = {{{"x*x+2*y*z", "z-y*x", "3*x+z*z"}}, {{"x^3+2*x*y*z", "z-y*x^2", "3*x+z*z*y"}}};
  const Field fields[2]
    = {[](const Point<3> &p) {
         return Tensor<1, 3>(
           {p[0] * p[0] + 2. * p[1] * p[2], p[2] - p[1] * p[0], 3. * p[0] + p[2] * p[2]});
       },
       [](const Point<3> &p) {
         return Tensor<1, 3>({p[0] * p[0] * p[0] + 2. * p[0] * p[1] * p[2],
                              p[2] - p[1] * p[0] * p[0],
                              3. * p[0] + p[2] * p[2] * p[1]});
       }};
  for (unsigned int degree = 1; degree <= 2; ++degree)
    {
      scene::Scene scene;
      scene.materials                   = {material("all", 1.)};
      scene.exact_solution.displacement = texts[degree - 1];
      Case       interpolant(scene, block(6), degree, fields[degree - 1]);
      const auto estimated = interpolant.estimate(estimate::Interpolation());
      const auto exact     = interpolant.estimate(estimate::ExactEnergy());
      // Inside, patches of degree 1 are symmetric and their derivatives right; those of
      // degree 2 are near.
      const double tolerance = degree == 1 ? 1e-8 : 0.02;
      unsigned int n_right   = 0;
      for (unsigned int cell = 0; cell < exact.indicators.size(); ++cell)
        if (std::abs(estimated.indicators[cell] / exact.indicators[cell] - 1.) < tolerance)
          ++n_right;
      std::cout << "interpolation, degree " << degree << ": index "
                << (std::abs(estimated.global / exact.global - 1.) < 0.02 ? "near 1" : "WRONG")
                << ", right in " << n_right << " cells of " << exact.indicators.size() << '\n';
    }
}

void
richardson()
{
  scene::Scene scene;
  scene.materials = {material("all", 1.)};
  scene.supports  = {clamp("x < 1e-9")};
  scene.loads     = {load("pull", scene::LoadType::traction, {{"1", "0", "0"}}, "x > 1 - 1e-9")};
  const Field quadratic = [](const Point<3> &p) { return Tensor<1, 3>({p[0] * p[0], 0., 0.}); };
  const auto  show      = [](const std::string &name, const estimate::Estimate &result) {
    std::cout << name << ": ";
    if (result.missing)
      std::cout << "missing, " << result.indicators.size() << " indicators\n";
    else
      std::cout << result.global << ", root of squares "
                << compare::root_of_squares(result.indicators) << '\n';
  };
  // E = 4, errors 0.5, 0.3, 0.2 in the energy norm, at a rate of N^-2/3.
  const auto level = [](const double error, const double sign) {
    return estimate::EnergyLevel{static_cast<unsigned long>(std::round(1e6 * std::pow(error, -3.))),
                                 4. - sign * error * error};
  };
  Case loaded(scene, block(2), 1, quadratic);
  show("two levels", loaded.estimate(estimate::Richardson(), {level(.3, 1.), level(.2, 1.)}));
  show("loads",
       loaded.estimate(estimate::Richardson(), {level(.5, 1.), level(.3, 1.), level(.2, 1.)}));
  show("energy falls",
       loaded.estimate(estimate::Richardson(), {level(.5, -1.), level(.3, -1.), level(.2, -1.)}));
  show("no convergence",
       loaded.estimate(estimate::Richardson(), {{1000, 1.}, {2000, 1.01}, {4000, 1.03}}));
  show("same mesh twice",
       loaded.estimate(estimate::Richardson(), {{1000, 1.}, {2000, 1.01}, {2000, 1.01}}));
  scene.supports[0].displacement[0] = "x+1";
  Case both(scene, block(2), 1, quadratic);
  expect_error([&] { both.estimate(estimate::Richardson()); });
  scene.loads.clear();
  Case moved(scene, block(2), 1, quadratic);
  show("displacement",
       moved.estimate(estimate::Richardson(), {level(.5, -1.), level(.3, -1.), level(.2, -1.)}));
}

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  differences();
  exact_solutions();
  residual_terms();
  interpolation_errors();
  richardson();
}
