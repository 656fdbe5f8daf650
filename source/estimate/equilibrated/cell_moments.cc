// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cells.h"

#include "tetradapt/mesh/edges.h"
#include "tetradapt/mesh/face_table.h"

namespace tetradapt::estimate
{
  void
  traction_moments(const CellState &state, const unsigned int f, Tensor<1, 3> *moments)
  {
    const auto        &face = mesh::face_vertices[f];
    const Tensor<1, 3> area = -3. * state.volume * state.gradients[f];
    // Edge of the cell between corners s and s + 1 of the face.
    static constexpr unsigned int edges[4][3] = {{1, 5, 4}, {3, 5, 2}, {0, 4, 3}, {2, 1, 0}};
    Tensor<1, 3>                  t[6], sum, bubbles;
    for (unsigned int s = 0; s < 3; ++s)
      {
        t[s] = state.stress[face[s]] * area;
        sum += t[s];
      }
    for (unsigned int s = 0; s < 3; ++s)
      moments[s] = (t[s] + sum) / 12.;
    for (unsigned int s = 0; s < 3; ++s)
      moments[3 + s] = (2. * sum - t[(s + 2) % 3]) / 15.;
    if (!state.has_bubbles)
      return;
    for (unsigned int s = 0; s < 3; ++s)
      {
        t[3 + s] = state.stress[4 + edges[f][s]] * area;
        bubbles += t[3 + s];
      }
    for (unsigned int s = 0; s < 3; ++s)
      moments[s] += (2. * bubbles - t[3 + (s + 1) % 3]) / 15.;
    for (unsigned int s = 0; s < 3; ++s)
      moments[3 + s] += (bubbles + t[3 + s]) * (4. / 45.);
  }

  void
  unbalanced_moments(const CellState &state, const unsigned int n, Tensor<1, 3> *moments)
  {
    SymmetricTensor<2, 3> sum, bubbles, mean;
    for (unsigned int i = 0; i < 4; ++i)
      sum += state.stress[i];
    if (state.has_bubbles)
      for (unsigned int e = 4; e < 10; ++e)
        bubbles += state.stress[e];
    mean = state.volume * (.25 * sum + .2 * bubbles);
    for (unsigned int i = 0; i < 4; ++i)
      moments[i] = mean * state.gradients[i] - state.force[i];
    if (n == 4)
      return;
    // Integrals of the stress times 4 b_i.
    SymmetricTensor<2, 3> first[4];
    for (unsigned int i = 0; i < 4; ++i)
      {
        first[i] = .2 * state.volume * (sum + state.stress[i]);
        if (state.has_bubbles)
          {
            first[i] += state.volume * (2. / 15.) * bubbles;
            for (unsigned int e = 0; e < 6; ++e)
              if (mesh::edge_vertices[e][0] == i || mesh::edge_vertices[e][1] == i)
                first[i] += state.volume * (2. / 15.) * state.stress[4 + e];
          }
      }
    for (unsigned int e = 0; e < 6; ++e)
      {
        const auto &v  = mesh::edge_vertices[e];
        moments[4 + e] = first[v[0]] * state.gradients[v[1]] + first[v[1]] * state.gradients[v[0]]
                         - state.force[4 + e];
      }
  }
} // namespace tetradapt::estimate
