// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_mechanics_stiffness_lanes_h
#define tetradapt_source_mechanics_stiffness_lanes_h

#include "stiffness_kernel.h"

#include "tetradapt/core/clones.h"

#include <cstddef>
#include <cstring>
#include <utility>

/**
 * Vectors' values at the nodes of a batch of cells, to and from lanes. A node's three numbers
 * lie next to each other, as do a component's lanes: in between are transpositions of 4 x 4
 * numbers, written with the compilers' vector types (GCC from 12 on, Clang), which come down
 * to whatever registers a clone has.
 */
namespace tetradapt::mechanics
{
  template <typename Number>
  struct LaneVectors
  {
    typedef Number Two __attribute__((vector_size(2 * sizeof(Number))));
    typedef Number Four __attribute__((vector_size(4 * sizeof(Number))));
    typedef Number Eight __attribute__((vector_size(8 * sizeof(Number))));
    typedef Number All __attribute__((vector_size(64)));
  };

  /** Of each four lanes: 0 of a, 0 of b, 1 of a, 1 of b; with @p from = 2: 2 and 3. */
  template <unsigned int from, typename All, std::size_t... i>
  TETRADAPT_INLINE All
  interleave(All a, All b, std::index_sequence<i...>)
  {
    constexpr std::size_t W = sizeof...(i);
    return __builtin_shufflevector(a, b, (i / 4 * 4 + from + i % 4 / 2 + i % 2 * W)...);
  }

  /** Of each four lanes: 0 and 1 of a, 0 and 1 of b; with @p from = 2: 2 and 3. */
  template <unsigned int from, typename All, std::size_t... i>
  TETRADAPT_INLINE All
  join(All a, All b, std::index_sequence<i...>)
  {
    constexpr std::size_t W = sizeof...(i);
    return __builtin_shufflevector(a, b, (i / 4 * 4 + from + i % 2 + i % 4 / 2 * W)...);
  }

  template <typename Number>
  TETRADAPT_INLINE typename LaneVectors<Number>::Four
  load_four(const Number *from)
  {
    typename LaneVectors<Number>::Four four;
    std::memcpy(&four, from, sizeof(four));
    return four;
  }

  template <typename Number>
  TETRADAPT_INLINE typename LaneVectors<Number>::Eight
  load_eight(const Number *x, unsigned int first, unsigned int second)
  {
    return __builtin_shufflevector(load_four(x + 3 * std::size_t(first)),
                                   load_four(x + 3 * std::size_t(second)),
                                   0,
                                   1,
                                   2,
                                   3,
                                   4,
                                   5,
                                   6,
                                   7);
  }

  /** Numbers of every fourth node from @p nodes on: four of each, of which the last is that
   * of the node after. */
  template <typename Number>
  TETRADAPT_INLINE typename LaneVectors<Number>::All
  load_every_fourth(const Number *x, const unsigned int *nodes)
  {
    const auto first = load_eight(x, nodes[0], nodes[4]);
    if constexpr (stiffness_lanes<Number> == 8)
      return first;
    else
      return __builtin_shufflevector(first,
                                     load_eight(x, nodes[8], nodes[12]),
                                     0,
                                     1,
                                     2,
                                     3,
                                     4,
                                     5,
                                     6,
                                     7,
                                     8,
                                     9,
                                     10,
                                     11,
                                     12,
                                     13,
                                     14,
                                     15);
  }

  /** The three components of @p x at a node of each lane, W numbers each, to @p u. Reads one
   * number after those of a node. */
  template <typename Number>
  TETRADAPT_INLINE void
  gather(const Number *x, const unsigned int *nodes, Number *u)
  {
    constexpr unsigned int W = stiffness_lanes<Number>;
    using All                = typename LaneVectors<Number>::All;
    constexpr std::make_index_sequence<W> i{};
    const All a = load_every_fourth(x, nodes), b = load_every_fourth(x, nodes + 1),
              c = load_every_fourth(x, nodes + 2), d = load_every_fourth(x, nodes + 3);
    const All ab = interleave<0>(a, b, i), cd = interleave<0>(c, d, i);
    const All z[3] = {join<0>(ab, cd, i),
                      join<2>(ab, cd, i),
                      join<0>(interleave<2>(a, b, i), interleave<2>(c, d, i), i)};
    std::memcpy(u, z, sizeof(z));
  }

  /** The same for nodes one of which may be the last of @p x. */
  template <typename Number>
  TETRADAPT_INLINE void
  gather_at_end(const Number *x, const unsigned int *nodes, Number *u)
  {
    constexpr unsigned int W = stiffness_lanes<Number>;
    for (unsigned int l = 0; l < W; ++l)
      for (unsigned int c = 0; c < 3; ++c)
        u[c * W + l] = x[3 * std::size_t(nodes[l]) + c];
  }

  /** Adds the three components @p f of each lane, W numbers each, to @p y at its node. */
  template <typename Number>
  TETRADAPT_INLINE void
  scatter(const Number *f, const unsigned int *nodes, Number *y)
  {
    constexpr unsigned int W = stiffness_lanes<Number>;
    using All                = typename LaneVectors<Number>::All;
    using Two                = typename LaneVectors<Number>::Two;
    constexpr std::make_index_sequence<W> i{};
    All                                   components[2];
    std::memcpy(components, f, sizeof(components));
    // The first two components of lanes 0, 1, 4, 5 and so on; of the others.
    const All          pairs[2] = {interleave<0>(components[0], components[1], i),
                                   interleave<2>(components[0], components[1], i)};
    alignas(64) Number values[2 * W];
    std::memcpy(values, pairs, sizeof(pairs));
#pragma GCC unroll 16
    for (unsigned int l = 0; l < W; ++l)
      {
        Number *const to = y + 3 * std::size_t(nodes[l]);
        Two           sum, more;
        std::memcpy(&sum, to, sizeof(Two));
        std::memcpy(&more, values + l % 4 / 2 * W + l / 4 * 4 + l % 2 * 2, sizeof(Two));
        sum += more;
        std::memcpy(to, &sum, sizeof(Two));
        to[2] += f[2 * W + l];
      }
  }
} // namespace tetradapt::mechanics

#endif
