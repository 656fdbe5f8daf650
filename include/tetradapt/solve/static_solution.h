// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_static_solution_h
#define tetradapt_solve_static_solution_h

#include "tetradapt/core/log.h"
#include "tetradapt/mechanics/energy_norm.h"
#include "tetradapt/mechanics/loads.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/scene/scene.h"
#include "tetradapt/solve/static_system.h"

#include <mpi.h>

#include <optional>

namespace tetradapt::solve
{
  /** A static equilibrium on one mesh. Its figures are the same on every rank. What is said of
   * energies holds for linear laws; of others, energy is 2 F(u_h) - 2 W(u_h) with the stored energy
   * W, twice the negative potential, or 2 W where supports prescribe displacements, strain_energy
   * is W, and norm is the root of 2 W. */
  struct StaticSolution
  {
    std::shared_ptr<const fem::Field> displacement;
    unsigned long                     n_dofs = 0; ///< 3 x nodes, supports included
    /** a(u_h,u_h) = int eps:C:eps, twice the strain energy without thermal strain, and twice
     * spring_energy. Where all prescribed displacements, and those of the ground, are zero it is
     * computed as 2 F(u_h) - a(u_h,u_h): the same for an exactly solved system, and with an
     * algebraic error delta (energy norm) less by delta^2, while F and a alone err by terms of
     * first order. So E minus it is |||u - u_h|||^2 for any iterate u_h, and it rises on a better
     * mesh only. */
    double energy = 0.;
    /** 1/2 int (eps - eps_th):C:(eps - eps_th), where eps_th is the thermal strain: of the body
     * alone. Without temperatures and springs and with fixed supports half of energy, and as exact
     * as it is. */
    double strain_energy = 0.;
    /** 1/2 int (u - u0) . K (u - u0) over the springs (mechanics::Springs); empty: none. */
    std::optional<double> spring_energy;
    /** What relative errors are of: the root of energy, but of twice strain_energy where
     * temperatures or springs act. */
    mechanics::EnergyNorm norm;
    /** F(u_h): tractions, body forces and thermal loads on the displacement. */
    double external_work = 0.;
    /** What each load of the scene amounts to on this mesh, and how well it is known. */
    std::vector<mechanics::LoadTotal> loads;

    unsigned int iterations = 0; ///< 0: direct solver
    std::string  solver;         ///< what solved it, for the log
    /** Sum of the lengths of the nodal forces that the solver is given at free unknowns: of loads,
     * thermal strain and prescribed displacements. Its tolerance is relative to them. */
    double load_magnitude = 0.;
    /** Energy norm of what conjugate gradients left, as they estimated it; 0: direct. */
    double algebraic_error = 0.;
    /** Iterations that the residual's tolerance alone would have taken, predicted from
     * the rate of convergence; equal to iterations where that ended it. */
    unsigned int iterations_to_tolerance = 0;
    /** The system, where the caller keeps it for dual problems; may be null. */
    std::shared_ptr<const StaticSystem> system;
  };

  /**
   * Solves the scene's static problem on @p mesh with degree @p degree. Collective
   * over @p communicator; every rank passes the same mesh.
   *
   * @throws InputError for supports and loads that make no sense on this mesh,
   *         NumericalError if the solver fails.
   */
  StaticSolution
  solve_static(const scene::Scene                  &scene,
               const mechanics::MaterialMap        &materials,
               std::shared_ptr<const mesh::TetMesh> mesh,
               unsigned int                         degree,
               MPI_Comm                             communicator,
               const core::Log                     &log);
} // namespace tetradapt::solve

#endif
