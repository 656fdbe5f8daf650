// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/equilibrated_cells.h"

#include "tetradapt/estimate/equilibrated_element.h"
#include "tetradapt/mesh/edges.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
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
    std::array<SymmetricTensor<2, 3>, 10> polynomial;
    std::vector<SymmetricTensor<2, 3>>    strains(points.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        strains[q] = materials.thermal_strain(mesh.regions[cell], position(cell, q));
        for (unsigned int i = 0; i < 10; ++i)
          polynomial[i] += projection[q][i] * strains[q];
      }
    double rest = 0., all = 0.;
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        SymmetricTensor<2, 3> difference = strains[q];
        for (unsigned int i = 0; i < 10; ++i)
          difference -= functions[q][i] * polynomial[i];
        const auto stress = region.law->stress(Tensor<2, 3>(difference));
        rest += weights[q] * region.law->complementary_density(stress);
        all += weights[q]
               * region.law->complementary_density(region.law->stress(Tensor<2, 3>(strains[q])));
      }
    if (rest > 1e-26 * all)
      state.thermal_oscillation = std::sqrt(rest * state.volume);
    for (unsigned int i = 0; i < 10; ++i)
      state.stress[i] -= region.law->stress(Tensor<2, 3>(polynomial[i]));
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
    std::vector<Tensor<1, 3>> values(points.size());
    Tensor<1, 3>              sum, moments[4];
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const Point<3> x = position(cell, q);
        for (const auto &load : region.variable_forces)
          values[q] += load.factor * load.value(x);
        for (unsigned int i = 0; i < 10; ++i)
          state.force[i] += state.volume * weights[q] * functions[q][i] * values[q];
        for (unsigned int i = 0; i < 4; ++i)
          moments[i] += weights[q] * functions[q][i] * values[q];
      }
    for (unsigned int i = 0; i < 4; ++i)
      sum += moments[i];
    // Inverse of the mean products (1 + delta_ij) / 20 of the coordinates.
    std::array<Tensor<1, 3>, 4> linear;
    for (unsigned int i = 0; i < 4; ++i)
      {
        linear[i] = 20. * moments[i] - 4. * sum;
        state.density[i] += linear[i];
      }
    // The coefficients of the bubbles in the nearest quadratic polynomial.
    state.curvature.fill(Tensor<1, 3>());
    for (unsigned int q = 0; q < points.size(); ++q)
      for (unsigned int e = 0; e < 6; ++e)
        state.curvature[e] += projection[q][4 + e] * values[q];
    double rest = 0., curved = 0., all = 0.;
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        Tensor<1, 3> difference = values[q];
        for (unsigned int i = 0; i < 4; ++i)
          difference -= points[q][i] * linear[i];
        curved += weights[q] * difference.norm_square();
        for (unsigned int e = 0; e < 6; ++e)
          difference -= EquilibratedElement::orthogonal_bubble(e, points[q]) * state.curvature[e];
        rest += weights[q] * difference.norm_square();
        all += weights[q] * values[q].norm_square();
      }
    // Rounding is neither curvature nor oscillation.
    state.has_curvature = curved > 1e-26 * all;
    if (rest > 1e-26 * all)
      state.force_oscillation = std::sqrt(rest * state.volume);
  }
} // namespace tetradapt::estimate
