// SPDX-License-Identifier: AGPL-3.0-or-later
// What decides about a cycle: Galerkin's potential energy, where it can tell meshes apart.

#include "tetradapt/adapt/acceptance.h"
#include "tetradapt/io/mesh_source.h"
#include "tetradapt/mesh/red_refinement.h"
#include "tetradapt/solve/static_solution.h"

#include <deal.II/base/mpi.h>

#include <iostream>

using namespace tetradapt;

namespace
{
  scene::Scene
  bar(const std::string &end_displacement)
  {
    scene::Scene scene;
    scene.mesh.source       = scene::MeshSource::bricks;
    scene.mesh.upper_corner = dealii::Point<3>(3, 1, 1);
    scene.mesh.cells        = {{{3, 1, 1}}};
    scene.materials.resize(1);
    scene.materials[0].name = "all";
    scene.supports.resize(2);
    scene.supports[0].name            = "left";
    scene.supports[0].selector.groups = {"x-min"};
    scene.supports[1].name            = "right";
    scene.supports[1].selector.groups = {"x-max"};
    scene.supports[1].components      = {{true, false, false}};
    scene.supports[1].displacement[0] = end_displacement;
    scene.loads.resize(1);
    scene.loads[0].name            = "side";
    scene.loads[0].selector.groups = {"z-max"};
    scene.loads[0].value           = {{"0", "0", "-0.1"}};
    return scene;
  }

  /** Pi on a mesh and on those of its red refinements. */
  void
  test_solutions(const std::string &end_displacement)
  {
    const core::Log    log;
    const scene::Scene scene = bar(end_displacement);
    auto               mesh  = std::make_shared<const mesh::TetMesh>(io::make_mesh(scene, 0, log));
    const mechanics::MaterialMap materials(scene, *mesh);
    std::string                  changes;
    adapt::CycleEnergy           before;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const solve::StaticSystem system(scene, materials, mesh, 1, MPI_COMM_SELF, log);
        const auto                solution = system.solve(nullptr, {});
        const adapt::CycleEnergy  now{system.prescribed().is_homogeneous()
                                        ? -0.5 * solution.energy
                                        : 0.5 * solution.energy - solution.external_work,
                                     0.};
        if (i > 0)
          changes += adapt::compare_energies(before, now, 0., 0.).is_worse() ? " worse" : " better";
        if (i > 0 && !adapt::compare_energies(now, before, 0., 0.).is_worse())
          changes += " BOTH";
        before = now;
        mesh   = std::make_shared<const mesh::TetMesh>(mesh::red_refine(*mesh));
      }
    std::cout << "right end moved by " << end_displacement << ":" << changes << "; "
              << adapt::why_energy_cannot_tell(scene, *mesh) << '\n';
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_solutions("0");
  test_solutions("0.2");
  test_solutions("0.1*y-0.2*z");

  const core::Log log;
  scene::Scene    curved = bar("0.1*y*z");
  std::cout << adapt::why_energy_cannot_tell(curved, io::make_mesh(curved, 0, log)) << '\n';
  scene::Scene nodal  = bar("0");
  nodal.loads[0].type = scene::LoadType::nodal_force;
  std::cout << adapt::why_energy_cannot_tell(nodal, io::make_mesh(nodal, 0, log)) << '\n';

  const auto worse = [](double change, double error, double swept, double of_loads = 0.) {
    return adapt::compare_energies({-2., 0.}, {-2. + change, error}, swept, of_loads).is_worse()
             ? "worse"
             : "kept";
  };
  std::cout << "rise 1e-6: " << worse(1e-6, 0., 0.) << "; rounding: " << worse(1e-11, 0., 0.)
            << "; explained by an algebraic error of 0.002: " << worse(1e-6, 2e-3, 0.)
            << ", of 0.001: " << worse(1e-6, 1e-3, 0.)
            << "; by a boundary that swept 1e-6 of the body: " << worse(5e-6, 0., 1e-6)
            << ", half of that: " << worse(5e-6, 0., 5e-7) << "; fall: " << worse(-1e-6, 0., 0.)
            << "; by loads that changed by 1e-6: " << worse(3e-6, 0., 0., 1e-6)
            << ", half of that: " << worse(3e-6, 0., 0., 5e-7) << '\n';
  const auto compared = [](double change, double swept) {
    return adapt::is_same_problem(change, swept) ? "energies" : "estimates";
  };
  std::cout << "compared: " << compared(1e-6, 0.) << " where loads changed by 1e-6, "
            << compared(1e-3, 0.) << " by 1e-3, " << compared(1e-3, 1e-3)
            << " if the boundary swept as much\n";
  std::cout << "estimates of 1, then 1.05: "
            << (adapt::is_worse_estimate(1., 1.05) ? "worse" : "kept")
            << ", 1.2: " << (adapt::is_worse_estimate(1., 1.2) ? "worse" : "kept") << '\n';
}
