// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_equilibrium_h
#define tetradapt_solve_equilibrium_h

#include "tetradapt/fem/field.h"
#include "tetradapt/mechanics/extent.h"
#include "tetradapt/mechanics/resultant.h"
#include "tetradapt/mechanics/springs.h"
#include "tetradapt/mechanics/supports.h"

#include <string>
#include <vector>

namespace tetradapt::solve
{
  /** What one support or one load does to the body. */
  struct ActingForce
  {
    std::string name; ///< in the scene
    /** "support", "spring", "reference point", or the load's type as the scene calls it */
    std::string          kind;
    mechanics::Resultant resultant;
    mechanics::Extent    extent;
  };

  /** The reference point of faces that are coupled rigidly. */
  struct ReferencePoint
  {
    std::string            name; ///< of the support
    dealii::Point<3>       point;
    mechanics::RigidMotion motion{};      ///< its translation, then its rotation in radians
    mechanics::Resultant   reaction;      ///< of what is prescribed, about the point
    dealii::Tensor<1, 3>   force, moment; ///< that the scene puts on it
  };

  /**
   * Whether the reactions of a solution balance its loads. They do but for the forces that the
   * solver left: the imbalance is its residual, not an error of the mesh.
   */
  struct Equilibrium
  {
    /** In the order of the scene; loads are followed by those on reference points. */
    std::vector<ActingForce>    supports, loads;
    std::vector<ReferencePoint> reference_points; ///< of rigid supports
    /** The sum of all of them; moments about the origin, as theirs. */
    mechanics::Resultant imbalance;
    /** The sum of the lengths of all nodal forces, those of the loads, thermal strain included,
     * and the reactions; where this is not above what the solver's tolerance leaves of the forces
     * of prescribed displacements, as in a body that moves as a whole, the sum of those. */
    double force_scale = 0.;
    /** Half the diagonal of the box around the body. */
    double lever = 0.;
    /** The larger of |force| / force_scale and |moment about the centre of the box| /
     * (force_scale lever) of the imbalance; 0 if no force acts. */
    double relative_imbalance = 0.;
    /** What may be left of it: Solver/Tolerance, but between 1e-8 and 1e-4; where the solver ends
     * at the error of the mesh, also what its own error in the energy norm, as it estimates it,
     * can have in it (see mechanics::Reactions::layer_energy). */
    double allowed_imbalance = 0.;

    bool
    is_balanced() const
    {
      return relative_imbalance <= allowed_imbalance; // false for NaN
    }
  };

  struct StaticSolution;

  /** What an equilibrium is computed from: a loaded system, on one mesh. */
  struct LoadedSystem
  {
    const scene::Scene                      &scene;
    const fem::Space                        &space;
    const mechanics::MaterialMap            &materials;
    const mechanics::PrescribedDisplacement &prescribed;
    const mechanics::Springs                &springs;
    const fem::Vector                       &forces; ///< of all loads
    /** Of laws that are not linear; see mechanics::compute_reactions(). */
    const fem::Vector *internal_forces;
    /** Of each load of the scene, the same on every rank. */
    const std::vector<mechanics::Resultant> &loads;
  };

  /** The reactions and the loads of @p solution. @param regions of its mesh. Collective; the same
   * on every rank. */
  Equilibrium
  compute_equilibrium(const LoadedSystem                          &system,
                      const StaticSolution                        &solution,
                      const std::vector<mechanics::RegionFigures> &regions);
} // namespace tetradapt::solve

#endif
