// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_left_out_h
#define tetradapt_adapt_left_out_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/estimate/comparison.h"
#include "tetradapt/mechanics/energy_norm.h"

namespace tetradapt::adapt
{
  /** What errors leave out of a mesh, an entry a point or line. Also checks that they leave
   * something. @throws core::InputError as ExcludedRegion::cells(). */
  std::vector<LeftOutRecord>
  left_out_of(const compare::ExcludedRegion &excluded, const mesh::TetMesh &mesh);

  /** What to tell the user when the first mesh is made, a message each; nothing of supports around
   * which nothing is left out. */
  std::vector<std::string>
  describe_left_out(const std::vector<LeftOutRecord> &left_out);

  /** Warnings of supports at points or on lines whose Excluded radius is 0, but which carry
   * something in the cycle of @p record. */
  std::vector<std::string>
  reaction_warnings(const CycleRecord &record);

  /**
   * What relative errors are relative to, without what is left out: the root of the stress energy
   * of the displacement in the other cells. The noise of @p whole is kept, and
   * @p whole is returned where nothing is left out. Collective.
   */
  mechanics::EnergyNorm
  norm_outside(estimate::Comparison &comparison, const mechanics::EnergyNorm &whole);
} // namespace tetradapt::adapt

#endif
