// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/fem/fixed_unknowns.h"

#include <deal.II/base/config.h>

#include <algorithm>

namespace tetradapt::fem
{
  Constraints
  make_constraints(const Space &space)
  {
    const auto      &layout   = *space.vector_layout();
    dealii::IndexSet relevant = layout.locally_owned_range();
    relevant.add_indices(layout.ghost_indices());
#if DEAL_II_VERSION_GTE(9, 6, 0)
    return Constraints(layout.locally_owned_range(), relevant);
#else
    return Constraints(relevant);
#endif
  }

  FixedUnknowns::FixedUnknowns(const Space &space, const Constraints &constraints)
    : bits(space.n_local_nodes(), 0)
  {
    const auto                                  &layout = *space.vector_layout();
    std::vector<std::pair<unsigned int, double>> fixed;
    for (const auto &line : constraints.get_lines())
      {
        AssertThrow(line.entries.empty(), dealii::ExcNotImplemented());
        if (layout.in_local_range(line.index) || layout.is_ghost_entry(line.index))
          fixed.emplace_back(layout.global_to_local(line.index), line.inhomogeneity);
      }
    std::sort(fixed.begin(), fixed.end());
    for (const auto &[unknown, value] : fixed)
      {
        numbers.push_back(unknown);
        fixed_values.push_back(value);
        bits[unknown / 3] |= 1u << unknown % 3;
      }
  }

  double
  FixedUnknowns::value(const unsigned int local_node, const unsigned int c) const
  {
    const auto found = std::lower_bound(numbers.begin(), numbers.end(), 3 * local_node + c);
    return fixed_values[found - numbers.begin()];
  }

  bool
  FixedUnknowns::is_homogeneous() const
  {
    return std::all_of(fixed_values.begin(), fixed_values.end(), [](auto v) { return v == 0.; });
  }
} // namespace tetradapt::fem
