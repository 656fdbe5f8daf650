// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_linear_solver_h
#define tetradapt_solve_linear_solver_h

#include "tetradapt/core/log.h"
#include "tetradapt/mechanics/stiffness.h"
#include "tetradapt/scene/study_parameters.h"

namespace tetradapt::solve
{
  using Vector = mechanics::Vector;

  /** What a preconditioner may build coarser levels from. */
  struct LinearModel
  {
    const mechanics::MeshPartition          &partition;
    const mechanics::DisplacementSpace      &space;
    const mechanics::MaterialMap            &materials;
    const mechanics::PrescribedDisplacement &prescribed;
  };

  struct LinearResult
  {
    unsigned int iterations = 0; ///< 0: direct
    std::string  description;    ///< solver and preconditioner, for the log
  };

  /**
   * Solves @p system, starting from @p x, which has the prescribed values. Chooses
   * by parameters: direct below the limit, else conjugate gradients with AMG
   * (degree 1) or p-multigrid on AMG (degree 2) until the residual is below the
   * tolerance times the norm of the load. Collective.
   * @throws core::NumericalError if it does not converge.
   */
  LinearResult
  solve_linear(const LinearModel             &model,
               const mechanics::LinearSystem &system,
               const scene::SolverParameters &parameters,
               const core::Log               &log,
               Vector                        &x);
} // namespace tetradapt::solve

#endif
