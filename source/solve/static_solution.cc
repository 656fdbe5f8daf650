// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/static_solution.h"

namespace tetradapt::solve
{
  StaticSolution
  solve_static(const scene::Scene                  &scene,
               const mechanics::MaterialMap        &materials,
               std::shared_ptr<const mesh::TetMesh> mesh,
               unsigned int                         degree,
               MPI_Comm                             communicator,
               const core::Log                     &log,
               const mesh::NodalField              *start)
  {
    return StaticSystem(scene, materials, std::move(mesh), degree, communicator, log)
      .solve(start, StaticSystem::Stop());
  }
} // namespace tetradapt::solve
