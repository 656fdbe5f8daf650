// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_transfer_h
#define tetradapt_compare_transfer_h

#include "tetradapt/compare/point_locator.h"

namespace tetradapt::compare
{
  /**
   * Evaluates @p field at the nodes of a field of the same degree on another mesh:
   * a good first iterate there. Points outside take the nearest cell's value.
   *
   * @param locator of the mesh of @p field.
   */
  mesh::NodalField
  interpolate(const mesh::NodalField              &field,
              const PointLocator                  &locator,
              std::shared_ptr<const mesh::TetMesh> new_mesh);
} // namespace tetradapt::compare

#endif
