// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_rigid_motions_h
#define tetradapt_mechanics_rigid_motions_h

#include "tetradapt/mechanics/springs.h"
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
   * Checks that the supports hold every connected part of the body: the six rigid motions R_i,
   * restricted to the prescribed components, must be independent, or with springs the matrix
   * int R_i . K R_j regular together with that of the prescribed components.
   * @param springs on the mesh, or null.
   * @throws core::InputError naming the part and a motion that is still free.
   */
  void
  check_rigid_motions(const mesh::TetMesh          &mesh,
                      const PrescribedDisplacement &prescribed,
                      const Springs                *springs = nullptr);

  /**
   * The least stiffness with which a rigid motion of a connected part is resisted: force per
   * displacement of its springs, times the square of the part's half diagonal for rotations that
   * are measured by the displacement there.
   * @param fixed what a fixed support counts for, and the largest value that is returned.
   */
  double
  least_stiffness(const mesh::TetMesh          &mesh,
                  const PrescribedDisplacement &prescribed,
                  const Springs                &springs,
                  double                        fixed);
} // namespace tetradapt::mechanics

#endif
