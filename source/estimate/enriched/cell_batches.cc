// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cell_batches.h"

#include <algorithm>

namespace tetradapt::estimate
{
  namespace
  {
    constexpr std::array<std::array<unsigned int, 2>, 6> voigt{
      {{{0, 0}}, {{1, 1}}, {{2, 2}}, {{1, 2}}, {{0, 2}}, {{0, 1}}}};
    constexpr std::array<std::array<unsigned int, 3>, 3> voigt_index{
      {{{0, 5, 4}}, {{5, 1, 3}}, {{4, 3, 2}}}};

    VoigtMatrix
    to_voigt(const dealii::SymmetricTensor<4, 3> &C)
    {
      VoigtMatrix D;
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          D.value[i][j] = C[voigt[i][0]][voigt[i][1]][voigt[j][0]][voigt[j][1]];
      return D;
    }

    /** The corners, edges and opposite faces of a cell with its vertices sorted. */
    struct SortedCell
    {
      std::array<unsigned int, 4> vertices; ///< local numbers, by increasing point number
      std::array<unsigned int, 6> edges;    ///< local number of sorted_edges

      explicit SortedCell(const std::array<unsigned int, 4> &points) : vertices{{0, 1, 2, 3}}
      {
        std::sort(vertices.begin(), vertices.end(), [&](unsigned int a, unsigned int b) {
          return points[a] < points[b];
        });
        for (unsigned int e = 0; e < 6; ++e)
          {
            const auto ends
              = std::minmax(vertices[sorted_edges[e][0]], vertices[sorted_edges[e][1]]);
            for (unsigned int k = 0; k < 6; ++k)
              if (ends == std::minmax(mesh::edge_vertices[k][0], mesh::edge_vertices[k][1]))
                edges[e] = k;
          }
      }
    };

    template <unsigned int q>
    void
    add_to_batch(const HierarchicalSurplus &surplus,
                 unsigned int               n_nodes,
                 unsigned int               cell,
                 SurplusBatch<q>           &batch)
    {
      const mesh::TetMesh &mesh     = surplus.mesh();
      const auto          &points   = mesh.cells[cell];
      const unsigned int   n_points = mesh.n_points();
      const SortedCell     sorted(points);
      const auto           directions = mesh::barycentric_gradients(mesh, cell);
      const double         volume     = mesh::cell_volume(mesh, cell);
      // The first cell fills the lanes that stay empty, without volume.
      const unsigned int first = batch.n_cells, last = first == 0 ? n_lanes : first + 1;
      for (unsigned int l = first; l < last; ++l)
        {
          unsigned int a = 0;
          for (unsigned int v = 0; v < 4; ++v)
            {
              batch.functions[a++][l] = points[sorted.vertices[v]];
              for (unsigned int d = 0; d < 3; ++d)
                batch.geometry.gradients[v][d][l] = directions[sorted.vertices[v]][d];
            }
          if (q == 3)
            for (const unsigned int e : sorted.edges)
              batch.functions[a++][l] = n_points + surplus.edges().cell_edges[cell][e];
          for (const unsigned int e : sorted.edges)
            batch.functions[a++][l] = n_nodes + surplus.function(cell, e);
          if (q == 3)
            for (const unsigned int f : sorted.vertices)
              batch.functions[a++][l] = n_nodes + surplus.function(cell, 6 + f);
          batch.geometry.volume[l] = l == first ? volume : 0.;
        }
      batch.cells[batch.n_cells++] = cell;
    }

    template <unsigned int q>
    void
    make_batches(const HierarchicalSurplus        &surplus,
                 unsigned int                      n_nodes,
                 const compare::Slice             &slice,
                 const std::map<int, VoigtMatrix> &tangents,
                 std::vector<SurplusBatch<q>>     &batches)
    {
      batches.reserve((slice.end - slice.begin) / n_lanes + tangents.size());
      std::map<int, std::size_t> open;
      for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
        {
          const int  region = surplus.mesh().regions[cell];
          const auto found  = open.find(region);
          if (found == open.end() || batches[found->second].n_cells == n_lanes)
            {
              open[region] = batches.size();
              batches.emplace_back();
              batches.back().D = &tangents.at(region);
            }
          add_to_batch(surplus, n_nodes, cell, batches[open[region]]);
        }
    }

    /** int d_m psi d_n psi over the volume, of a surplus function with the Bernstein
     * coefficients @p c, in barycentric directions m and n. */
    template <unsigned int q>
    std::array<std::array<double, 4>, 4>
    direction_products(const std::array<double, Bernstein<q>::n> &c)
    {
      constexpr auto                       raised = Bernstein<q>::raised();
      constexpr auto                       mass   = Bernstein<q>::mass();
      std::array<std::array<double, 4>, 4> result{};
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          for (unsigned int a = 0; a < Bernstein<q>::m; ++a)
            for (unsigned int b = 0; b < Bernstein<q>::m; ++b)
              result[i][j]
                += q * q * mass.mean[a][b] * c[raised.number[a][i]] * c[raised.number[b][j]];
      return result;
    }

    /** a_K(psi, psi) of a function with these products of directions. */
    void
    diagonal_block(const CellBatchGeometry                    &geometry,
                   const VoigtMatrix                          &D,
                   const std::array<std::array<double, 4>, 4> &products,
                   Lanes (&block)[9])
    {
      const auto &g = geometry.gradients;
      Lanes       P[3][3]; // int d_i psi d_j psi
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            P[i][j] = Lanes{};
            for (unsigned int m = 0; m < 4; ++m)
              for (unsigned int n = 0; n < 4; ++n)
                P[i][j] += products[m][n] * g[m][i] * g[n][j];
            P[i][j] *= geometry.volume;
          }
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          {
            Lanes sum = {};
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                sum += D.value[voigt_index[c][i]][voigt_index[d][j]] * P[i][j];
            block[3 * c + d] = sum;
          }
    }

    template <unsigned int q>
    void
    add_diagonal(const std::vector<SurplusBatch<q>> &batches,
                 unsigned int                        n_nodes,
                 double                             *diagonal)
    {
      using Coefficients = std::array<double, Bernstein<q>::n>;
      std::vector<std::array<std::array<double, 4>, 4>> products;
      for (unsigned int e = 0; e < 6; ++e)
        {
          Coefficients c{};
          if (q == 2)
            c[4 + e] = 2.;
          else
            {
              c[4 + 2 * e]     = HierarchicalSurplus::odd_scale / 3.;
              c[4 + 2 * e + 1] = -c[4 + 2 * e];
            }
          products.push_back(direction_products<q>(c));
        }
      for (unsigned int f = 16; f < Bernstein<q>::n; ++f)
        {
          Coefficients c{};
          c[f] = HierarchicalSurplus::face_scale / 6.;
          products.push_back(direction_products<q>(c));
        }
      const unsigned int first = Bernstein<q>::n - products.size();
      for (const auto &batch : batches)
        for (unsigned int k = 0; k < products.size(); ++k)
          {
            Lanes block[9];
            diagonal_block(batch.geometry, *batch.D, products[k], block);
            for (unsigned int l = 0; l < batch.n_cells; ++l)
              {
                const unsigned int function = batch.functions[first + k][l] - n_nodes;
                double *const      target   = diagonal + 9 * static_cast<std::size_t>(function);
                for (unsigned int i = 0; i < 9; ++i)
                  target[i] += block[i][l];
              }
          }
    }
  } // namespace

  CellBatches::CellBatches(const HierarchicalSurplus    &surplus,
                           unsigned int                  n_nodes,
                           const mechanics::MaterialMap &materials,
                           const compare::Slice         &slice)
  {
    for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
      {
        const int region = surplus.mesh().regions[cell];
        if (tangents.count(region) == 0)
          tangents[region] = to_voigt(materials.linear_law(region).tangent_at_rest());
      }
    if (surplus.degree() == 1)
      make_batches(surplus, n_nodes, slice, tangents, quadratic);
    else
      make_batches(surplus, n_nodes, slice, tangents, cubic);
  }

  void
  add_surplus_diagonal(const CellBatches &batches, unsigned int n_nodes, double *diagonal)
  {
    add_diagonal(batches.quadratic, n_nodes, diagonal);
    add_diagonal(batches.cubic, n_nodes, diagonal);
  }
} // namespace tetradapt::estimate
