// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/fem/fixed_unknowns.h"

#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <map>

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
          // Only unknowns of the same node are named.
          for (const auto &[other, factor] : *constraints.get_constraint_entries(number))
            result.add_entry(unknown, unknown - c + other % 3, factor);
          result.set_inhomogeneity(unknown, constraints.get_inhomogeneity(number));
        }
    if (constraints.is_closed())
      result.close();
    return result;
  }

  namespace
  {
    /** A line of Constraints: row . u = value at a node. */
    struct Line
    {
      unsigned int         component;
      bool                 is_plain = true; ///< names no other unknown
      dealii::Tensor<1, 3> row;
      double               value;
    };

    InclinedNode
    inclined_node(const unsigned int node, const std::vector<Line> &lines)
    {
      InclinedNode                      result{node, {}, {}};
      std::vector<dealii::Tensor<1, 3>> basis;
      for (const Line &line : lines)
        {
          dealii::Tensor<1, 3> direction = line.row;
          // Rows of two lines are independent, as each has a component of its own.
          for (const auto &other : basis)
            direction -= (other * direction) * other;
          const double length = direction.norm();
          direction /= length;
          basis.push_back(direction);
          result.held += symmetrize(outer_product(direction, direction));
          // The row is made of those before and this direction.
          result.value += (line.value - line.row * result.value) / length * direction;
        }
      return result;
    }
  } // namespace

  FixedUnknowns::FixedUnknowns(const Space &space, const Constraints &constraints)
    : bits(space.n_local_nodes(), 0)
  {
    const auto                               &layout = *space.vector_layout();
    std::map<unsigned int, std::vector<Line>> lines_of; // of local nodes, ascending
    for (const auto &line : constraints.get_lines())
      if (layout.in_local_range(line.index) || layout.is_ghost_entry(line.index))
        {
          const unsigned int unknown = layout.global_to_local(line.index);
          Line               result;
          result.component             = unknown % 3;
          result.value                 = line.inhomogeneity;
          result.row[result.component] = 1.;
          for (const auto &[other, factor] : line.entries)
            {
              AssertThrow(other / 3 == line.index / 3, dealii::ExcNotImplemented());
              result.row[other % 3] = -factor;
              result.is_plain       = false;
            }
          lines_of[unknown / 3].push_back(result);
        }
    for (auto &[node, lines] : lines_of)
      {
        std::sort(lines.begin(), lines.end(), [](const Line &a, const Line &b) {
          return a.component < b.component;
        });
        if (std::all_of(lines.begin(), lines.end(), [](const Line &l) { return l.is_plain; }))
          for (const Line &line : lines)
            {
              numbers.push_back(3 * node + line.component);
              fixed_values.push_back(line.value);
              bits[node] |= 1u << line.component;
            }
        else
          {
            inclined_nodes.push_back(inclined_node(node, lines));
            bits[node] = is_inclined;
          }
      }
  }

  const InclinedNode &
  FixedUnknowns::inclined_at(const unsigned int local_node) const
  {
    return *std::lower_bound(inclined_nodes.begin(),
                             inclined_nodes.end(),
                             local_node,
                             [](const InclinedNode &a, const unsigned int b) {
                               return a.node < b;
                             });
  }

  dealii::Tensor<1, 3>
  FixedUnknowns::free_part(const unsigned int local_node, const dealii::Tensor<1, 3> &vector) const
  {
    if (bits[local_node] == is_inclined)
      return vector - inclined_at(local_node).held * vector;
    dealii::Tensor<1, 3> result = vector;
    for (unsigned int c = 0; c < 3; ++c)
      if (is_fixed(local_node, c))
        result[c] = 0.;
    return result;
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
    for (const InclinedNode &inclined : inclined_nodes)
      if (3 * inclined.node < vector.locally_owned_size())
        {
          dealii::Tensor<1, 3> u;
          for (unsigned int c = 0; c < 3; ++c)
            u[c] = vector.local_element(3 * inclined.node + c);
          u += inclined.value - inclined.held * u;
          for (unsigned int c = 0; c < 3; ++c)
            vector.local_element(3 * inclined.node + c) = u[c];
        }
  }

  bool
  FixedUnknowns::is_homogeneous() const
  {
    return std::all_of(fixed_values.begin(), fixed_values.end(), [](auto v) { return v == 0.; })
           && std::all_of(inclined_nodes.begin(), inclined_nodes.end(), [](const auto &inclined) {
                return inclined.value.norm_square() == 0.;
              });
  }
} // namespace tetradapt::fem
