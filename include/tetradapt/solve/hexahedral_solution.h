// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_solution_h
#define tetradapt_solve_hexahedral_solution_h

#include "tetradapt/core/log.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/hexahedral_field.h"
#include "tetradapt/scene/scene.h"

#include <mpi.h>

#include <memory>
#include <optional>

namespace tetradapt::solve
{
  /** The solution on one mesh of a sequence, each a refinement of the one before. */
  struct NestedSolution
  {
    double n_dofs = 0.;
    /** 2 F(u_h) - a(u_h,u_h): it rises to that of the solution u, and what is missing
     * is the square of the error's energy norm. */
    double gain = 0.;
    /** An indicator of the error's energy norm: proportional to it, more or less. */
    double indicator = 0.;
  };

  /**
   * The energy norm of the error on the last of several nested meshes. What refinement
   * gained is the decrease of the error's square, exactly; that divided by the decrease
   * of the indicator's square tells what the indicator must be multiplied by. Of the
   * factors over the last one to five steps the largest is taken. The result is not
   * larger than what these steps leave if the error falls like N^-0.25 only.
   *
   * @return empty for fewer than three levels, or if nothing was gained.
   */
  std::optional<double>
  calibrated_error(const std::vector<NestedSolution> &levels);

  /** A static equilibrium on hexahedra. Every MPI rank holds all of it. */
  struct HexahedralSolution
  {
    std::shared_ptr<mesh::HexahedralField> displacement;
    unsigned long                          n_dofs = 0;  ///< supports included
    double                                 energy = 0.; ///< a(u_h,u_h)
    double norm = 0.; ///< what relative errors are of, see mechanics::EnergyNorm
    /** Energy norm: calibrated_error() and a margin for what it was found to lack on
     * singular edges, half of it for degree 2, 30 % for degree 3. */
    double estimated_error = 0.;
    /** a(u,u) of the solution itself, by extrapolation and without the estimate's
     * margin; empty where loads and prescribed displacements act together. */
    std::optional<double>       extrapolated_energy;
    bool                        reached = false; ///< the tolerance, or the limit came first
    std::vector<NestedSolution> levels;
  };

  /**
   * Solves a scene, whose body is made of boxes, with functions of degree
   * ReferenceParameters::degree on hexahedra, refining these where the error is until
   * the estimated error in the energy norm, relative to the solution's, is below
   * @p tolerance, or the next system would have more unknowns than
   * ReferenceParameters::max_dofs. Supports and loads act as on @p mesh, the scene's
   * first. Collective.
   *
   * @throws core::InputError for what hexahedra cannot do (see make_hexahedral_grid()),
   *         core::NumericalError if the solver fails.
   */
  HexahedralSolution
  solve_on_hexahedra(const scene::Scene           &scene,
                     const mechanics::MaterialMap &materials,
                     const mesh::TetMesh          &mesh,
                     double                        tolerance,
                     MPI_Comm                      communicator,
                     const core::Log              &log);
} // namespace tetradapt::solve

#endif
