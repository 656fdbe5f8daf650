// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_doubts_h
#define tetradapt_adapt_doubts_h

#include "tetradapt/fem/field.h"
#include "tetradapt/scene/scene.h"

#include <string>
#include <vector>

namespace tetradapt::adapt
{
  /** A sentence for the user that says what is doubtful, and what follows from it. */
  struct Doubt
  {
    std::string what, advice;
  };

  /**
   * What makes a solution doubtful although its error estimates are small: displacements,
   * strains or rotations too large for linear theory (compare::Deformation) where @p scene is
   * solved by that, and slender parts of
   * few linear elements across that bend or twist, where these are much too stiff and
   * estimators see a part of their error only.
   *
   * Strains and rotations count if they exceed the limit in a thousandth of the volume: at a
   * singular edge they grow beyond all limits as the mesh gets finer.
   *
   * @return empty if nothing is doubtful. Collective.
   */
  std::vector<Doubt>
  doubts_about(const fem::Field &displacement, const scene::Scene &scene);
} // namespace tetradapt::adapt

#endif
