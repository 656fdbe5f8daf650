// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_acceptance_h
#define tetradapt_adapt_acceptance_h

#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/scene.h"

#include <string>

namespace tetradapt::adapt
{
  /**
   * Why the potential energy Pi(u_h) = 1/2 a(u_h,u_h) - F(u_h), thermal loads being part of
   * F, cannot tell a better mesh of this scene from a worse one; empty if it can.
   *
   * A Galerkin solution minimises Pi over its space, and |||u - u_h|||^2 = 2 (Pi(u_h) -
   * Pi(u)) for every space that represents the prescribed displacements: then less is
   * better. Prescribed displacements that elements of @p mesh do not represent (that are
   * not linear on its faces) make a mistake of the same order; forces at nodes
   * grow with the number of nodes.
   */
  std::string
  why_energy_cannot_tell(const scene::Scene &scene, const mesh::TetMesh &mesh);

  /** What decides about a cycle. */
  struct CycleEnergy
  {
    double potential = 0.; ///< Pi(u_h) of the iterate
    /** Energy norm of what conjugate gradients left: Pi is above its minimum by half
     * the square. */
    double algebraic_error = 0.;
  };

  /** The outcome. */
  struct EnergyTest
  {
    double change    = 0.; ///< of Pi; negative is better
    double allowance = 0.; ///< a rise up to this says nothing
    bool
    is_worse() const
    {
      return change > allowance;
    }
  };

  /**
   * Whether two cycles solve the same problem, so that energies can be compared: the change of
   * loads or volume is within what moving the boundary explains, and quadrature.
   * @param change see change_of_problem(). @param swept as for compare_energies().
   */
  bool
  is_same_problem(double change, double swept);

  /**
   * Compares a cycle with the one before. Allowed are rounding, the squares of the algebraic
   * errors, twice the relative change of the loads (Pi is quadratic in them), and what a change
   * of the body's shape may do: Pi is an integral over the
   * body, and moving the boundary through the part s of its volume changes it by about
   * s |Pi|, three times that where stresses are concentrated.
   *
   * @param swept part of the body's volume that projecting the boundary swept.
   * @param change relative, of loads and volume.
   */
  EnergyTest
  compare_energies(const CycleEnergy &before,
                   const CycleEnergy &after,
                   double             swept,
                   double             change);

  /** The same by the norms of refinement indicators, which say less: a tenth more is allowed. */
  bool
  is_worse_estimate(double before, double after);
} // namespace tetradapt::adapt

#endif
