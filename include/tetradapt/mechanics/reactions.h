// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_reactions_h
#define tetradapt_mechanics_reactions_h

#include "tetradapt/fem/field.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mechanics/resultant.h"
#include "tetradapt/mechanics/supports.h"

namespace tetradapt::mechanics
{
  /** What the supports do to the body. The forces and moments that the scene puts on reference
   * points are loads, and not in it. */
  struct Reactions
  {
    std::vector<Resultant>     supports; ///< one a support, in the order of the scene
    std::vector<unsigned long> n_nodes;  ///< that each of them holds
    /** Sum of the lengths of the reactions at the nodes. */
    double magnitude = 0.;
    /**
     * a(v,v) for the three displacements v that are one in direction c where component c is
     * free and zero where it is prescribed. The forces that a solver leaves on the free
     * unknowns sum to (r, v), at most the energy norm of its error times the root of this: how
     * far reactions can be from balancing the loads. Zero unless asked for.
     */
    std::array<double, 3> layer_energy{};
  };

  /**
   * The consistent reactions of a displacement, r = int sigma : grad N - F at every unknown that
   * supports prescribe, with the stress sigma of @p displacement before thermal strain is taken
   * off and the nodal forces F of all loads, thermal strain included. Their sum and that of the
   * loads is zero, in forces and in moments, as far as the equations are solved; it does not
   * depend on how good the mesh is. Only cells at supports are looked at.
   *
   * A reaction belongs to the support that prescribes the unknown. Where several do, it is
   * divided in proportion to the area of the faces that each has at the node; equally, if none
   * has any. Where a node slides, each support has what is along its own directions. Nodes that
   * are coupled to a reference point count whole: their sum is along its prescribed components, as
   * far as the equations are solved.
   *
   * @param forces F.
   * @param internal_forces int P : grad N of laws that are not linear: then moments are
   *        those about the deformed positions, where forces act. Null for linear laws, whose
   *        stress at supports is computed here.
   * @param displacement in the space, with its pressure in mixed form.
   * @param with_layer_energy whether that is wanted.
   * Collective; the same on every rank.
   */
  Reactions
  compute_reactions(const MaterialMap            &materials,
                    const PrescribedDisplacement &prescribed,
                    const fem::Vector            &forces,
                    const fem::Vector            *internal_forces,
                    const fem::Field             &displacement,
                    unsigned int                  n_supports,
                    bool                          with_layer_energy);
} // namespace tetradapt::mechanics

#endif
