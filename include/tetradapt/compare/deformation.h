// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_deformation_h
#define tetradapt_compare_deformation_h

#include "tetradapt/fem/field.h"

#include <vector>

namespace tetradapt::compare
{
  /** How large a displacement and its derivatives are, for judging whether linear theory
   * holds. Strains and rotations are those in the cells' centres. */
  struct Deformation
  {
    /** Above these, linear theory is doubtful: its error is of their order. Without a
     * unit; rotations in radians. */
    static constexpr double limit = 0.1;

    /** Diagonal of the box of all displacements, over that of the body. A
     * body that moves as a whole without turning has none. */
    double displacement = 0.;
    double strain       = 0.; ///< largest principal one, absolute
    double rotation     = 0.; ///< largest angle, |curl u| / 2
    /** Parts of the volume where strain and rotation exceed the limit. */
    double strained_part = 0., rotated_part = 0.;
  };

  /** Collective. */
  Deformation
  deformation(const fem::Field &u_h);

  /** How much of a body bends, as far as some of its cells are concerned. */
  struct Bending
  {
    double volume = 0.; ///< part of the body's volume that the cells are
    double strain = 0.; ///< part of int |eps|^2 that is theirs
    /** Standard deviation of the rotation in these cells over the root mean square of
     * their strain: about the length over the thickness where slender parts bend or
     * twist, below one where they are stretched or sheared. */
    double slenderness = 0.;
  };

  /** @param cells one entry a cell. Collective. */
  Bending
  bending(const fem::Field &u_h, const std::vector<bool> &cells);
} // namespace tetradapt::compare

#endif
