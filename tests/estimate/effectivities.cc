// SPDX-License-Identifier: AGPL-3.0-or-later
// Indices of effectivity of the estimators that need no reference, on the manufactured
// solutions of prm/verification, and with a Poisson ratio of 0.49.

#include "tetradapt/estimate/extrapolation.h"
#include "tetradapt/estimate/flux_projection.h"
#include "tetradapt/estimate/interpolation.h"
#include "tetradapt/estimate/residual.h"
#include "tetradapt/io/mesh_source.h"
#include "tetradapt/scene/scene_reader.h"

#include <deal.II/base/mpi.h>

#include <iostream>

using namespace tetradapt;
using namespace tetradapt::estimate;

/** What an index has to lie between. */
struct Range
{
  std::shared_ptr<const Estimator> estimator;
  double                           smallest, largest;
};

void
check(const std::string        &what,
      const scene::Scene       &scene,
      const unsigned int        n,
      const std::vector<Range> &ranges)
{
  const std::vector<EnergyLevel> levels;
  core::Log                      log;
  scene::Scene                   on_mesh = scene;
  on_mesh.mesh.cells                     = {{{n, n, n}}};
  const auto mesh = std::make_shared<mesh::TetMesh>(io::make_mesh(on_mesh, 0, log));
  const mechanics::MaterialMap materials(on_mesh, *mesh);
  const auto                   system = std::make_shared<const solve::StaticSystem>(
    on_mesh, materials, mesh, on_mesh.degree, MPI_COMM_WORLD, log);
  auto solution   = system->solve(nullptr, solve::StaticSystem::Stop());
  solution.system = system;
  estimate::Comparison comparison(
    solution.displacement, materials, on_mesh.exact_solution, nullptr, MPI_COMM_WORLD);
  const estimate::EstimateInput input{comparison, on_mesh, solution, levels};
  const double                  error = comparison.to_exact_solution().energy;
  for (const Range &range : ranges)
    {
      const double index = range.estimator->estimate(input).global / error;
      std::cout << what << ", " << range.estimator->traits().name << ": ";
      if (index >= range.smallest && index <= range.largest)
        std::cout << "between " << range.smallest << " and " << range.largest << '\n';
      else
        std::cout << index << " IS NOT\n";
    }
}

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                        folder = SOURCE_DIR "/../../prm/verification/";
  check("degree 1",
        scene::read_scene(folder + "manufactured_p1.prm"),
        8,
        {{std::make_shared<PatchRecovery>(), 0.9, 1.1},
         {std::make_shared<Averaging>(), 0.9, 1.2},
         {std::make_shared<Residual>(), 0.8, 1.6},
         {std::make_shared<Interpolation>(), 0.8, 1.3},
         {std::make_shared<LocalDegreeExtrapolation>(), 0.95, 1.05}});
  scene::Scene quadratic = scene::read_scene(folder + "manufactured_p2.prm");
  check("degree 2",
        quadratic,
        5,
        {{std::make_shared<PatchRecovery>(), 0.9, 1.1},
         {std::make_shared<Averaging>(), 0.5, 1.1},
         {std::make_shared<Residual>(), 0.8, 1.6},
         {std::make_shared<Interpolation>(), 0.8, 1.3},
         {std::make_shared<LocalDegreeExtrapolation>(), 0.95, 1.05}});
  // With nu = 0.49 and c = (1, 1, -2) instead of (1, 2, -1) the displacement has no divergence,
  // and neither lambda nor its large values enter the loads: f = 3 pi^2 mu u, mu = 1.
  const std::string u[3] = {"sin(pi*x)*cos(pi*y)*cos(pi*z)",
                            "cos(pi*x)*sin(pi*y)*cos(pi*z)",
                            "-2*cos(pi*x)*cos(pi*y)*sin(pi*z)"};
  for (unsigned int i = 0; i < 3; ++i)
    {
      quadratic.exact_solution.displacement[i] = u[i];
      quadratic.supports[0].displacement[i]    = u[i];
    }
  quadratic.exact_solution.gradient.fill("");
  quadratic.materials[0].constants["Young modulus"] = 2.98;
  quadratic.materials[0].constants["Poisson ratio"] = 0.49;
  for (auto &load : quadratic.loads)
    if (load.type == scene::LoadType::body_force)
      for (unsigned int i = 0; i < 3; ++i)
        load.value[i] = "3*pi^2*(" + u[i] + ")";
    else
      load.value = {{"0", "0", "4*pi*cos(pi*x)*cos(pi*y)"}};
  check("nu = 0.49, degree 2",
        quadratic,
        4,
        {{std::make_shared<PatchRecovery>(), 0.9, 1.1},
         {std::make_shared<Residual>(), 0.8, 4.},
         {std::make_shared<LocalDegreeExtrapolation>(), 0.8, 1.2}});
}
