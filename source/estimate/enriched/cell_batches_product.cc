// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cell_batches.h"

#include "tetradapt/core/clones.h"

namespace tetradapt::estimate
{
  namespace
  {
    /** Bernstein coefficients of hierarchical ones: vertices, middles of edges (for q =
     * 3), surplus of edges, of faces. */
    TETRADAPT_INLINE void
    to_bernstein(const Lanes (&h)[10][3], Lanes (&c)[10][3])
    {
      for (unsigned int k = 0; k < 3; ++k)
        {
          for (unsigned int v = 0; v < 4; ++v)
            c[v][k] = h[v][k];
          for (unsigned int e = 0; e < 6; ++e)
            c[4 + e][k]
              = 0.5 * (h[sorted_edges[e][0]][k] + h[sorted_edges[e][1]][k]) + 2. * h[4 + e][k];
        }
    }

    /** The transposed map, for forces. */
    TETRADAPT_INLINE void
    from_bernstein(const Lanes (&c)[10][3], Lanes (&h)[10][3])
    {
      for (unsigned int k = 0; k < 3; ++k)
        {
          for (unsigned int v = 0; v < 4; ++v)
            h[v][k] = c[v][k];
          for (unsigned int e = 0; e < 6; ++e)
            {
              h[sorted_edges[e][0]][k] += 0.5 * c[4 + e][k];
              h[sorted_edges[e][1]][k] += 0.5 * c[4 + e][k];
              h[4 + e][k] = 2. * c[4 + e][k];
            }
        }
    }

    /** Edges of the face opposite vertex f. */
    constexpr unsigned int face_edges[4][3] = {{1, 4, 5}, {2, 3, 5}, {0, 3, 4}, {0, 1, 2}};
    constexpr double       odd              = HierarchicalSurplus::odd_scale / 3.;
    constexpr double       face             = HierarchicalSurplus::face_scale / 6.;

    TETRADAPT_INLINE void
    to_bernstein(const Lanes (&h)[20][3], Lanes (&c)[20][3])
    {
      for (unsigned int k = 0; k < 3; ++k)
        {
          for (unsigned int v = 0; v < 4; ++v)
            c[v][k] = h[v][k];
          for (unsigned int e = 0; e < 6; ++e)
            {
              const unsigned int i = sorted_edges[e][0], j = sorted_edges[e][1];
              c[4 + 2 * e][k]     = (4. * h[4 + e][k] - h[j][k]) / 3. + odd * h[10 + e][k];
              c[4 + 2 * e + 1][k] = (4. * h[4 + e][k] - h[i][k]) / 3. - odd * h[10 + e][k];
            }
          for (unsigned int f = 0; f < 4; ++f)
            {
              const auto &e   = face_edges[f];
              Lanes       sum = 2. * (h[4 + e[0]][k] + h[4 + e[1]][k] + h[4 + e[2]][k]);
              for (unsigned int v = 0; v < 4; ++v)
                if (v != f)
                  sum -= h[v][k];
              c[16 + f][k] = sum / 3. + face * h[16 + f][k];
            }
        }
    }

    TETRADAPT_INLINE void
    from_bernstein(const Lanes (&c)[20][3], Lanes (&h)[20][3])
    {
      for (unsigned int k = 0; k < 3; ++k)
        {
          for (unsigned int v = 0; v < 4; ++v)
            h[v][k] = c[v][k];
          for (unsigned int e = 0; e < 6; ++e)
            {
              const unsigned int i = sorted_edges[e][0], j = sorted_edges[e][1];
              const Lanes        first = c[4 + 2 * e][k], second = c[4 + 2 * e + 1][k];
              h[i][k] -= second / 3.;
              h[j][k] -= first / 3.;
              h[4 + e][k]  = 4. / 3. * (first + second);
              h[10 + e][k] = odd * (first - second);
            }
          for (unsigned int f = 0; f < 4; ++f)
            {
              const Lanes third = c[16 + f][k] / 3.;
              for (const unsigned int e : face_edges[f])
                h[4 + e][k] += 2. * third;
              for (unsigned int v = 0; v < 4; ++v)
                if (v != f)
                  h[v][k] -= third;
              h[16 + f][k] = face * c[16 + f][k];
            }
        }
    }

    template <unsigned int q>
    TETRADAPT_INLINE void
    gather(const SurplusBatch<q> &batch, const double *x, Lanes (&h)[Bernstein<q>::n][3])
    {
      for (unsigned int a = 0; a < Bernstein<q>::n; ++a)
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            const double *const value = x + 3 * static_cast<std::size_t>(batch.functions[a][l]);
            h[a][0][l]                = value[0];
            h[a][1][l]                = value[1];
            h[a][2][l]                = value[2];
          }
    }

    /** Forces of one batch, in hierarchical functions, of the values gathered in @p h. */
    template <unsigned int q>
    TETRADAPT_INLINE void
    batch_forces(const SurplusBatch<q> &batch,
                 const Lanes (&h)[Bernstein<q>::n][3],
                 Lanes (&forces)[Bernstein<q>::n][3])
    {
      Lanes c[Bernstein<q>::n][3], f[Bernstein<q>::n][3];
      to_bernstein(h, c);
      multiply_stiffness<q>(batch.geometry, *batch.D, c, f);
      from_bernstein(f, forces);
    }

    template <unsigned int q>
    TETRADAPT_INLINE void
    multiply_all(const std::vector<SurplusBatch<q>> &batches, const double *x, double *forces)
    {
      Lanes h[Bernstein<q>::n][3], f[Bernstein<q>::n][3];
      for (const auto &batch : batches)
        {
          gather(batch, x, h);
          batch_forces(batch, h, f);
          for (unsigned int a = 0; a < Bernstein<q>::n; ++a)
            for (unsigned int l = 0; l < n_lanes; ++l)
              {
                double *const target = forces + 3 * static_cast<std::size_t>(batch.functions[a][l]);
                target[0] += f[a][0][l];
                target[1] += f[a][1][l];
                target[2] += f[a][2][l];
              }
        }
    }


    template <unsigned int q>
    TETRADAPT_INLINE void
    products_of_all(const std::vector<SurplusBatch<q>> &batches,
                    const double                       *x,
                    const double                       *y,
                    double                             *products)
    {
      Lanes h[Bernstein<q>::n][3], f[Bernstein<q>::n][3];
      for (const auto &batch : batches)
        {
          gather(batch, x, h);
          batch_forces(batch, h, f);
          gather(batch, y, h);
          Lanes sum = {};
          for (unsigned int a = 0; a < Bernstein<q>::n; ++a)
            for (unsigned int c = 0; c < 3; ++c)
              sum += f[a][c] * h[a][c];
          for (unsigned int l = 0; l < batch.n_cells; ++l)
            products[batch.cells[l]] = sum[l];
        }
    }
  } // namespace

  TETRADAPT_CLONES void
  multiply_batches(const CellBatches &batches, const double *x, double *forces)
  {
    multiply_all(batches.quadratic, x, forces);
    multiply_all(batches.cubic, x, forces);
  }

  TETRADAPT_CLONES void
  batch_products(const CellBatches &batches, const double *x, const double *y, double *products)
  {
    products_of_all(batches.quadratic, x, y, products);
    products_of_all(batches.cubic, x, y, products);
  }
} // namespace tetradapt::estimate
