// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cells.h"

#include "element.h"

#include "tetradapt/mesh/edges.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    /** Means of a constant times the functions. */
    void
    set_constant_means(const double value, std::array<double, 10> &means)
    {
      for (unsigned int i = 0; i < 10; ++i)
        means[i] = (i < 4 ? .25 : .2) * value;
    }
  } // namespace

  std::array<double, 10>
  quadratic_functions(const mesh::Barycentric &b)
  {
    std::array<double, 10> f;
    for (unsigned int i = 0; i < 4; ++i)
      f[i] = b[i];
    for (unsigned int e = 0; e < 6; ++e)
      f[4 + e] = 4. * b[mesh::edge_vertices[e][0]] * b[mesh::edge_vertices[e][1]];
    return f;
  }

  template <typename Value>
  std::array<Value, 10>
  CellStates::polynomial_with(const std::array<Value, 10> &means) const
  {
    std::array<Value, 10> result{};
    for (unsigned int i = 0; i < 10; ++i)
      for (unsigned int j = 0; j < 10; ++j)
        result[i] += inverse_products(i, j) * means[j];
    return result;
  }

  void
  CellStates::compute_stress(const unsigned int cell, const Region &region, CellState &state) const
  {
    std::array<Tensor<1, 3>, 10> u;
    for (unsigned int i = 0; i < u_h.n_nodes_per_cell(); ++i)
      u[i] = u_h.values[u_h.node(cell, i)];
    if (u_h.degree() == 1)
      {
        Tensor<2, 3> G;
        for (unsigned int i = 0; i < 4; ++i)
          G += outer_product(u[i], state.gradients[i]);
        state.stress.fill(region.law->stress(G));
      }
    else
      {
        // At corner v, with respect to the barycentric coordinate k, the derivative
        // of the displacement is 3 u_v for k = v, else 4 u_(edge k v) - u_k.
        unsigned int edge[4][4];
        for (unsigned int e = 0; e < 6; ++e)
          {
            const auto &v    = mesh::edge_vertices[e];
            edge[v[0]][v[1]] = edge[v[1]][v[0]] = 4 + e;
          }
        for (unsigned int v = 0; v < 4; ++v)
          {
            Tensor<2, 3> G = outer_product(3. * u[v], state.gradients[v]);
            for (unsigned int k = 0; k < 4; ++k)
              if (k != v)
                G += outer_product(4. * u[edge[k][v]] - u[k], state.gradients[k]);
            state.stress[v] = region.law->stress(G);
          }
      }
    std::fill(state.stress.begin() + 4, state.stress.end(), SymmetricTensor<2, 3>());
    state.has_bubbles         = false;
    state.thermal_oscillation = 0.;
    if (region.thermal)
      add_thermal_stress(cell, region, state);
  }

  void
  CellStates::add_thermal_stress(const unsigned int cell,
                                 const Region      &region,
                                 CellState         &state) const
  {
    materials.thermal_density().sample_compactly(mesh, cell, samples);
    std::array<double, 10> means{};
    for (const auto &point : samples)
      {
        const auto f = quadratic_functions(point.b);
        for (unsigned int i = 0; i < 10; ++i)
          means[i] += point.weight * f[i] * point.value[0];
      }
    if (samples.size() == 1)
      set_constant_means(samples[0].value[0], means);
    const auto   polynomial = polynomial_with(means);
    const auto   unit       = region.law->stress(Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()));
    const double energy     = region.law->complementary_density(unit); // of a strain of one
    double       rest = 0., all = 0.;
    for (const auto &point : samples)
      {
        const auto f          = quadratic_functions(point.b);
        double     difference = point.value[0];
        for (unsigned int i = 0; i < 10; ++i)
          difference -= f[i] * polynomial[i];
        rest += point.weight * energy * difference * difference;
        all += point.weight * energy * point.value[0] * point.value[0];
      }
    if (samples.size() > 1 && rest > 1e-26 * all)
      state.thermal_oscillation = std::sqrt(rest * state.volume);
    for (unsigned int i = 0; i < 10; ++i)
      state.stress[i] -= polynomial[i] * unit;
    state.has_bubbles = true;
  }

  void
  CellStates::compute_force(const unsigned int cell, const Region &region, CellState &state) const
  {
    for (unsigned int i = 0; i < 10; ++i)
      state.force[i] = (i < 4 ? .25 : .2) * state.volume * region.constant_force;
    state.density.fill(region.constant_force);
    state.force_oscillation = 0.;
    state.has_curvature     = false;
    if (region.variable_forces.empty())
      return;
    state.curvature.fill(Tensor<1, 3>());
    for (const mechanics::VolumeDensity *force : region.variable_forces)
      add_variable_force(cell, *force, state);
  }

  void
  CellStates::add_variable_force(const unsigned int              cell,
                                 const mechanics::VolumeDensity &force,
                                 CellState                      &state) const
  {
    force.sample(mesh, cell, samples);
    std::array<Tensor<1, 3>, 10> means;
    for (const auto &point : samples)
      {
        const auto f = quadratic_functions(point.b);
        for (unsigned int i = 0; i < 10; ++i)
          means[i] += point.weight * f[i] * point.value;
      }
    Tensor<1, 3> sum;
    for (unsigned int i = 0; i < 10; ++i)
      state.force[i] += state.volume * means[i];
    for (unsigned int i = 0; i < 4; ++i)
      sum += means[i];
    // Inverse of the mean products (1 + delta_ij) / 20 of the coordinates.
    std::array<Tensor<1, 3>, 4> linear;
    for (unsigned int i = 0; i < 4; ++i)
      {
        linear[i] = 20. * means[i] - 4. * sum;
        state.density[i] += linear[i];
      }
    // The coefficients of the bubbles in the nearest quadratic polynomial.
    const auto polynomial = polynomial_with(means);
    double     rest = 0., curved = 0., all = 0.;
    for (const auto &point : samples)
      {
        Tensor<1, 3> difference = point.value;
        for (unsigned int i = 0; i < 4; ++i)
          difference -= point.b[i] * linear[i];
        curved += point.weight * difference.norm_square();
        for (unsigned int e = 0; e < 6; ++e)
          difference -= EquilibratedElement::orthogonal_bubble(e, point.b) * polynomial[4 + e];
        rest += point.weight * difference.norm_square();
        all += point.weight * point.value.norm_square();
      }
    // Rounding is neither curvature nor oscillation.
    if (curved > 1e-26 * all)
      {
        state.has_curvature = true;
        for (unsigned int e = 0; e < 6; ++e)
          state.curvature[e] += polynomial[4 + e];
      }
    if (rest > 1e-26 * all)
      state.force_oscillation += std::sqrt(rest * state.volume);
  }
} // namespace tetradapt::estimate
