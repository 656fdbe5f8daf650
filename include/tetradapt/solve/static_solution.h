// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_static_solution_h
#define tetradapt_solve_static_solution_h

#include "tetradapt/core/log.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/nodal_field.h"
#include "tetradapt/scene/scene.h"

#include <mpi.h>

namespace tetradapt::solve
{
  /** A static equilibrium on one mesh. Every MPI rank holds all of it. */
  struct StaticSolution
  {
    std::shared_ptr<mesh::NodalField> displacement;
    unsigned long                     n_dofs = 0; ///< 3 x nodes, supports included
    /** a(u_h,u_h) = int eps:C:eps, twice the strain energy without thermal strain. */
    double energy = 0.;
    /** Stored energy 1/2 int (eps - eps_th):C:(eps - eps_th). */
    double strain_energy = 0.;
    /** F(u_h): tractions, body forces and thermal loads on the displacement. */
    double       external_work = 0.;
    unsigned int iterations    = 0; ///< 0: direct solver
    std::string  solver;            ///< what solved it, for the log
  };

  /**
   * Solves the scene's static problem on @p mesh with degree @p degree. Collective
   * over @p communicator; every rank passes the same mesh.
   *
   * @param start a displacement on another or the same mesh evaluated at this
   *        mesh's nodes, used as the first iterate; may be null.
   * @throws InputError for supports and loads that make no sense on this mesh,
   *         NumericalError if the solver fails.
   */
  StaticSolution
  solve_static(const scene::Scene                  &scene,
               const mechanics::MaterialMap        &materials,
               std::shared_ptr<const mesh::TetMesh> mesh,
               unsigned int                         degree,
               MPI_Comm                             communicator,
               const core::Log                     &log,
               const mesh::NodalField              *start = nullptr);
} // namespace tetradapt::solve

#endif
