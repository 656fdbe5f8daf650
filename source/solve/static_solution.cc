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
               const core::Log                     &log)
  {
    return StaticSystem(scene, materials, std::move(mesh), degree, communicator, log)
      .solve(nullptr, StaticSystem::Stop());
  }
} // namespace tetradapt::solve
