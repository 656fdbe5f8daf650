// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/fem/fixed_unknowns.h"

#include <deal.II/lac/affine_constraints.h>

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

  Constraints
  restrict_to(const Space &space, const Space &finer, const Constraints &constraints)
  {
    Constraints result = make_constraints(space);
    for (unsigned int node = 0; node < space.n_local_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const unsigned int fine   = finer.local_node(space.field_node(node));
          const auto         number = finer.vector_layout()->local_to_global(3 * fine + c);
          if (!constraints.is_constrained(number))
            continue;
          const auto unknown = space.vector_layout()->local_to_global(3 * node + c);
          result.add_line(unknown);
          result.set_inhomogeneity(unknown, constraints.get_inhomogeneity(number));
        }
    if (constraints.is_closed())
      result.close();
    return result;
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

  void
  FixedUnknowns::distribute(Vector &vector) const
  {
    for (std::size_t k = 0; k < numbers.size() && numbers[k] < vector.locally_owned_size(); ++k)
      vector.local_element(numbers[k]) = fixed_values[k];
  }

  bool
  FixedUnknowns::is_homogeneous() const
  {
    return std::all_of(fixed_values.begin(), fixed_values.end(), [](auto v) { return v == 0.; });
  }
} // namespace tetradapt::fem
