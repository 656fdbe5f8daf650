// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/held_directions.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::mechanics
{
  namespace
  {
    /** The part of a direction that others do not have. Below the first it depends on them: normals
     * that differ by less are those of one plane, as files and surfaces have it. From the
     * second on it is a direction of its own. In between a node that slides along a wall would be
     * clamped by another support that holds it nearly along the normal. */
    constexpr double dependent = 1e-3, independent = 0.05;

    /** Of the values: what rounding may make of them. */
    constexpr double rounding = 1e-9;

    /** Entries of a projector that differ by less from 0 and 1 are these. */
    constexpr double aligned = 1e-12;
  } // namespace

  std::optional<HeldDirections::Conflict>
  HeldDirections::add(const Tensor<1, 3> &direction, const double value, const unsigned int owner)
  {
    Tensor<1, 3> rest     = direction;
    double       expected = 0., size = std::abs(value), largest = -1.;
    unsigned int other = owner;
    for (unsigned int k = 0; k < n; ++k)
      {
        const double part = basis[k] * direction;
        rest -= part * basis[k];
        expected += part * values[k];
        size = std::max(size, std::abs(values[k]));
        if (std::abs(part) > largest)
          {
            largest = std::abs(part);
            other   = owners[k];
          }
      }
    // Once more: what is left may be small.
    for (unsigned int k = 0; k < n; ++k)
      rest -= (basis[k] * rest) * basis[k];
    const double length = rest.norm();
    if (n == 3 || length < dependent)
      {
        if (std::abs(value - expected) > (rounding + 2. * length) * size)
          return Conflict{other, expected, 0.};
        return std::nullopt;
      }
    if (length < independent)
      return Conflict{other, expected, length};
    basis[n]  = rest / length;
    values[n] = (value - expected) / length;
    owners[n] = owner;
    ++n;
    return std::nullopt;
  }

  SymmetricTensor<2, 3>
  HeldDirections::projector() const
  {
    SymmetricTensor<2, 3> result;
    for (unsigned int k = 0; k < n; ++k)
      result += symmetrize(outer_product(basis[k], basis[k]));
    return result;
  }

  Tensor<1, 3>
  HeldDirections::value() const
  {
    Tensor<1, 3> result;
    for (unsigned int k = 0; k < n; ++k)
      result += values[k] * basis[k];
    return result;
  }

  std::vector<Tensor<1, 3>>
  HeldDirections::others() const
  {
    HeldDirections all = *this;
    while (all.n < 3)
      {
        // The axis of which the directions so far have least.
        const SymmetricTensor<2, 3> held = all.projector();
        unsigned int                best = 0;
        for (unsigned int c = 1; c < 3; ++c)
          if (held[c][c] < held[best][best])
            best = c;
        Tensor<1, 3> axis;
        axis[best] = 1.;
        all.add(axis, 0., 0);
      }
    return {all.basis.begin() + n, all.basis.end()};
  }

  std::optional<unsigned char>
  HeldDirections::components() const
  {
    const SymmetricTensor<2, 3> held = projector();
    unsigned char               bits = 0;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          const double nearest = i == j && held[i][j] > 0.5 ? 1. : 0.;
          if (std::abs(held[i][j] - nearest) > aligned)
            return std::nullopt;
          if (nearest == 1.)
            bits |= 1u << i;
        }
    return bits;
  }
} // namespace tetradapt::mechanics
