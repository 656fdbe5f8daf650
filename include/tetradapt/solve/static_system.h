// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_static_system_h
#define tetradapt_solve_static_system_h

#include "tetradapt/core/log.h"
#include "tetradapt/fem/field.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mechanics/supports.h"
#include "tetradapt/scene/scene.h"
#include "tetradapt/solve/equilibrium.h"

#include <mpi.h>

#include <memory>

namespace tetradapt::solve
{
  struct StaticSolution;

  /**
   * The system of a static problem on one mesh, with what solves it: numbering,
   * matrix, supports, factorisation or preconditioner. Made once a mesh, used for the
   * displacement and again for dual problems, which differ in their right-hand side
   * only. Laws that are not linear have a system a step instead, and no dual problems.
   * Collective over the communicator.
   */
  class StaticSystem
  {
  public:
    /** When conjugate gradients end. */
    struct Stop
    {
      /** Residual relative to the load; the scene's Solver/Tolerance where 0. */
      double residual = 0.;
      /** Energy norm that the iterate's own error may have, estimated while
       * iterating; 0: does not count. */
      double algebraic_error = 0.;
      /** The same relative to the energy norm of what is solved for, where nothing is
       * known of that; counts for first iterates of zero only. */
      double relative_error = 0.;
    };

    /** Numbers, assembles, and prepares the solver. Keeps references to @p scene
     * and @p materials, and shares the mesh. @throws as solve_static(). */
    StaticSystem(const scene::Scene                  &scene,
                 const mechanics::MaterialMap        &materials,
                 std::shared_ptr<const mesh::TetMesh> mesh,
                 unsigned int                         degree,
                 MPI_Comm                             communicator,
                 const core::Log                     &log);
    ~StaticSystem();

    /** The displacement under the scene's loads: of linear laws by one linear solve, of others
     * by Newton's method, which @p stop does not concern. @param start first iterate, in space()
     * and, if it has a pressure, that in pressure_space(); or null. */
    StaticSolution
    solve(const fem::Field *start, const Stop &stop) const;

    /** The displacement under other nodal forces, zero at all supports; a dual solution. */
    std::shared_ptr<const fem::Field>
    solve_dual(const fem::Vector &forces, const Stop &stop) const;

    /** One step of what solves it: @p displacement = an approximate inverse of the
     * matrix times @p forces, symmetric and positive, zero at supports. Preconditions larger
     * spaces. */
    void
    precondition(const fem::Vector &forces, fem::Vector &displacement) const;

    /** The loads' forces on the nodes; where supports hold a component also. */
    const fem::Vector &
    nodal_forces() const;

    /** The space of the displacement; all vectors have its layout. Solutions share it. */
    const std::shared_ptr<const fem::Space> &
    space() const;

    /** The space of the pressure; null in displacement form. */
    std::shared_ptr<const fem::PressureSpace>
    pressure_space() const;

    /** The reactions and the loads of a @p solution of this system, and how they balance.
     * @param regions of the solution's mesh. Collective; the same on every rank. */
    Equilibrium
    equilibrium(const StaticSolution                        &solution,
                const std::vector<mechanics::RegionFigures> &regions) const;

    /** What the supports prescribe at the nodes. */
    const mechanics::PrescribedDisplacement &
    prescribed() const;

    /** Whether every prescribed displacement and that of the ground under springs is zero. */
    bool
    is_driven_by_loads() const;

  private:
    /** @throws core::InputError if a law is not linear. */
    void
    require_linear() const;

    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace tetradapt::solve

#endif
