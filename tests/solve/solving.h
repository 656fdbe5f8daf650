// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_tests_solve_solving_h
#define tetradapt_tests_solve_solving_h

#include "tetradapt/solve/static_solution.h"

#include "../mechanics/bodies.h"

namespace bodies
{
  using SolverType = scene::SolverParameters::Type;

  /** Solves @p scene on @p body with all ranks, and without messages. */
  inline solve::StaticSolution
  solve_scene(const scene::Scene                   &scene,
              const std::shared_ptr<mesh::TetMesh> &body,
              const unsigned int                    degree,
              const mesh::NodalField               *start = nullptr)
  {
    auto selected = std::make_shared<mesh::TetMesh>(*body);
    select(*selected, scene);
    const mechanics::MaterialMap materials(scene, *selected);
    return solve::solve_static(
      scene, materials, selected, degree, MPI_COMM_WORLD, core::Log(), start);
  }
} // namespace bodies

#endif
