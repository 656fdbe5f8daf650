// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_transfer_h
#define tetradapt_compare_transfer_h

#include "tetradapt/compare/point_locator.h"
#include "tetradapt/fem/field.h"

namespace tetradapt::compare
{
  /**
   * Evaluates @p field at the nodes of @p space, of the same degree, which may be on another mesh:
   * a good first iterate there. Each rank locates its own nodes. Points outside take the nearest
   * cell's value.
   *
   * @param locator of the mesh of @p field.
   * @param pressures on @p space, where the pressure is wanted also; null if there is none.
   * Collective.
   */
  std::shared_ptr<const fem::Field>
  interpolate(const mesh::NodalField                   &field,
              const PointLocator                       &locator,
              std::shared_ptr<const fem::Space>         space,
              std::shared_ptr<const fem::PressureSpace> pressures);
} // namespace tetradapt::compare

#endif
