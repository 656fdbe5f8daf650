// SPDX-License-Identifier: AGPL-3.0-or-later
// The estimators on fields whose difference is known: the true displacement is a
// stretch, the solution nine tenths of it. Nothing is computed twice.

#include "tetradapt/core/exceptions.h"
#include "tetradapt/estimate/estimator.h"
#include "tetradapt/mesh/bricks.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>

using namespace tetradapt;

constexpr double stretch = 0.02;

scene::Scene
make_scene()
{
  scene::Scene              scene;
  scene::MaterialParameters material;
  material.name          = "all";
  material.young_modulus = 1.;
  material.poisson_ratio = 0.25; // lambda + 2 mu = 1.2
  scene.materials        = {material};
  return scene;
}

/** The displacement (factor * stretch * x, 0, 0). */
std::shared_ptr<mesh::NodalField>
stretched(const std::array<unsigned int, 3> &n, const unsigned int degree, const double factor)
{
  auto field = std::make_shared<mesh::NodalField>(
    std::make_shared<mesh::TetMesh>(mesh::bricks({0., 0., 0.}, {1., 1., 1.}, n)), degree);
  for (unsigned int i = 0; i < field->n_nodes(); ++i)
    field->values[i][0] = factor * stretch * field->node_position(i)[0];
  return field;
}

double
root_of_squares(const std::vector<double> &values)
{
  double sum = 0.;
  for (const double v : values)
    sum += v * v;
  return std::sqrt(sum);
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

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                           world = MPI_COMM_WORLD;

  std::cout << "names:";
  for (const auto &name : estimate::estimator_names())
    std::cout << " '" << name << "'";
  std::cout << '\n';
  expect_error([]() { estimate::make_estimator("residual"); });

  const scene::Scene           scene = make_scene();
  const auto                   u_h   = stretched({{2, 2, 1}}, 1, 0.9);
  const mechanics::MaterialMap materials(scene, u_h->mesh());

  scene::TruthParameters truth;
  truth.displacement = {{"0.02*x", "0", "0"}};
  truth.gradient     = {{"0.02", "0", "0", "0", "0", "0", "0", "0", "0"}};
  const auto sampling
    = std::make_shared<compare::ReferenceSampling>(stretched({{5, 3, 3}}, 2, 1.), materials, world);
  estimate::Comparison comparison(u_h, materials, truth, sampling, world);

  // The difference is a strain of 0.1 stretch along x: energy 1.2 (0.1 stretch)^2.
  const double unit = 0.1 * stretch * std::sqrt(1.2);
  for (const auto &name : estimate::estimator_names())
    {
      const auto estimator = estimate::make_estimator(name);
      const auto estimate  = estimator->estimate({comparison});
      std::cout << estimator->name() << ": needs reference " << estimator->needs_reference()
                << ", exact " << estimator->needs_exact_displacement() << "; ";
      if (estimator->is_energy_norm())
        std::cout << "global " << estimate.global / unit << ", root of squares "
                  << root_of_squares(estimate.indicators) / unit;
      else
        {
          // Nodes at x = 0 do not move and count zero: 6 of 18.
          double sum = 0.;
          for (const double v : estimate.indicators)
            sum += v;
          std::cout << "global " << estimate.global / 0.1 << ", sum " << sum / 0.1;
        }
      std::cout << ", cells " << estimate.indicators.size() << '\n';
    }

  std::cout << "computed once: " << (&comparison.to_reference() == &comparison.to_reference())
            << (&comparison.to_truth() == &comparison.to_truth())
            << (&comparison.ren() == &comparison.ren())
            << (&comparison.locator() == &comparison.locator()) << ", truth before reference "
            << (&comparison.ren() != &comparison.ren_to_reference()) << '\n';
  std::cout << "effect of the reference: l2 "
            << comparison.to_reference().l2 / comparison.to_truth().l2 << ", mean REN "
            << comparison.ren_to_reference().mean / comparison.ren().mean << '\n';

  const scene::TruthParameters nothing;
  estimate::Comparison         alone(u_h, materials, nothing, nullptr, world);
  std::cout << "knows " << alone.has_reference() << alone.has_exact_displacement() << '\n';
  expect_error([&]() { alone.to_reference(); });
  expect_error([&]() { alone.ren(); });
  expect_error([&]() { alone.to_truth(); });

  using Driver = scene::AdaptivityParameters::Driver;
  for (const Driver driver : {Driver::energy, Driver::ren, Driver::exact})
    std::cout << estimate::estimator_name(driver) << '\n';
}
