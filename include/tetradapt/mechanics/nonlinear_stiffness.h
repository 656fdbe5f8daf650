// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_nonlinear_stiffness_h
#define tetradapt_mechanics_nonlinear_stiffness_h

#include "tetradapt/fem/space.h"
#include "tetradapt/mechanics/linear_operator.h"
#include "tetradapt/mechanics/material_history.h"
#include "tetradapt/mechanics/tangent_field.h"

namespace tetradapt::mechanics
{
  /** What a displacement does to a body, the same on every rank. */
  struct Deformed
  {
    /** Whether every law has a response everywhere and det F is positive at the quadrature
     * points and at the vertices of all cells; nothing else but worst_place has a meaning if
     * not. */
    bool   is_admissible = false;
    double stored_energy = 0.; ///< integral of the laws' energy
    /** How large rounding lets the norm of the forces be where they should cancel. */
    double force_rounding = 0.;
    /** The smallest det F, and the centroid at rest of the cell that has it. */
    double           least_jacobian = 0.;
    dealii::Point<3> worst_place;
  };

  /**
   * The internal forces of laws that are not linear, total Lagrangian: every law is asked at each
   * quadrature point for its response to F = I + du/dX, and X is the position at rest. The
   * quadrature is that of the linear stiffness: one point for degree 1, four for degree 2.
   *
   * Like the linear operators a rank works on all cells that touch its nodes, so that
   * nothing but ghost values of the displacement is exchanged.
   */
  class NonlinearStiffness
  {
  public:
    /** Keeps references. */
    NonlinearStiffness(const fem::Space &space, const MaterialMap &materials);

    /**
     * The forces int P(F) : grad N on the owned unknowns, supports left aside.
     * @param u any displacement; ghost values are fetched. @param forces is overwritten.
     * Writes what laws remember after this displacement; accept() makes it count. Collective.
     */
    Deformed
    internal_forces(const Vector &u, Vector &forces) const;

    /** The tangents dP/dF at @p u. Collective.
     * @throws core::NumericalError, on all ranks, if a law has none there. */
    TangentField
    linearise(const Vector &u) const;

    /** What the laws remember after the last internal_forces() is where they go on from. */
    void
    accept();

  private:
    class Cell;

    const fem::Space              &space;
    const MaterialMap             &materials;
    std::vector<mesh::Barycentric> points; ///< of equal weight
    mutable MaterialHistory        history;
  };
} // namespace tetradapt::mechanics

#endif
