// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/field_evaluator.h"

namespace tetradapt::compare
{
  namespace
  {
    /** sum += factor * u (x) g */
    void
    add_product(Tensor<2, 3>       &sum,
                const double        factor,
                const Tensor<1, 3> &u,
                const Tensor<1, 3> &g)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          sum[i][j] += factor * u[i] * g[j];
    }
  } // namespace

  std::array<Tensor<2, 3>, 4>
  vertex_gradients(const mesh::NodalField &field, const unsigned int cell)
  {
    const auto                  g        = mesh::barycentric_gradients(field.mesh(), cell);
    const auto                 &vertices = field.mesh().cells[cell];
    const auto                 &edges    = field.edges().cell_edges[cell];
    const unsigned int          n_points = field.mesh().n_points();
    Tensor<2, 3>                common; // what the vertices' functions add everywhere
    std::array<Tensor<2, 3>, 4> result;
    for (unsigned int i = 0; i < 4; ++i)
      {
        const Tensor<1, 3> &u = field.values[vertices[i]];
        add_product(common, -1., u, g[i]);
        add_product(result[i], 4., u, g[i]);
      }
    for (unsigned int e = 0; e < 6; ++e)
      {
        // grad (4 b_i b_j) = 4 (b_i g_j + b_j g_i): 4 g_j at vertex i.
        const auto &[i, j]    = mesh::edge_vertices[e];
        const Tensor<1, 3> &u = field.values[n_points + edges[e]];
        add_product(result[i], 4., u, g[j]);
        add_product(result[j], 4., u, g[i]);
      }
    for (auto &r : result)
      r += common;
    return result;
  }

  FieldEvaluator::FieldEvaluator(const mesh::NodalField &field)
    : nodal_field(field), linear(field.degree() == 1)
  {
    const unsigned int n_cells = field.mesh().n_cells();
    gradients.resize(std::size_t(n_cells) * (linear ? 1 : 4));
    for (unsigned int cell = 0; cell < n_cells; ++cell)
      if (linear)
        {
          const auto g = mesh::barycentric_gradients(field.mesh(), cell);
          for (unsigned int i = 0; i < 4; ++i)
            add_product(gradients[cell], 1., field.values[field.mesh().cells[cell][i]], g[i]);
        }
      else
        {
          const auto at_vertices = vertex_gradients(field, cell);
          for (unsigned int i = 0; i < 4; ++i)
            gradients[4 * std::size_t(cell) + i] = at_vertices[i];
        }
  }
} // namespace tetradapt::compare
