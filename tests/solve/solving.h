// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_tests_solve_solving_h
#define tetradapt_tests_solve_solving_h

#include "tetradapt/fem/replication.h"
#include "tetradapt/solve/static_solution.h"

#include "../mechanics/bodies.h"

namespace bodies
{
  using SolverType = scene::SolverParameters::Type;

  /** A solution, and its displacement on every rank. */
  struct WholeSolution : solve::StaticSolution
  {
    std::shared_ptr<const mesh::NodalField> whole;
  };

  /** Solves @p scene on @p body with all ranks, and without messages. */
  inline WholeSolution
  solve_scene(const scene::Scene                   &scene,
              const std::shared_ptr<mesh::TetMesh> &body,
              const unsigned int                    degree,
              const mesh::NodalField               *start = nullptr)
  {
    auto selected = std::make_shared<mesh::TetMesh>(*body);
    select(*selected, scene);
    const mechanics::MaterialMap materials(scene, *selected);
    const solve::StaticSystem    system(
      scene, materials, selected, degree, MPI_COMM_WORLD, core::Log());
    std::shared_ptr<const fem::Field> first;
    if (start != nullptr)
      first = fem::distribute(*start, system.space());
    WholeSolution result{system.solve(first.get(), {}), nullptr};
    result.whole = fem::replicate(*result.displacement);
    return result;
  }
} // namespace bodies

#endif
