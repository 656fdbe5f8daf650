// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_rigid_motions_h
#define tetradapt_mechanics_rigid_motions_h

#include "tetradapt/mechanics/supports.h"

namespace tetradapt::mechanics
{
  /** Displacement at @p x of rigid motion @p k about @p centre: translations along
   * x, y, z, then rotations about axes through the centre divided by @p length. */
  dealii::Tensor<1, 3>
  rigid_motion(unsigned int            k,
               const dealii::Point<3> &x,
               const dealii::Point<3> &centre,
               double                  length);

  /**
   * Checks that the supports hold every connected part of the body: the six rigid
   * motions, restricted to the prescribed components, must be independent.
   * @throws core::InputError naming the part and a motion that is still free.
   */
  void
  check_rigid_motions(const mesh::TetMesh &mesh, const PrescribedDisplacement &prescribed);
} // namespace tetradapt::mechanics

#endif
