// SPDX-License-Identifier: AGPL-3.0-or-later
#include "stiffness_kernel.h"

#include "stiffness_lanes.h"

namespace tetradapt::mechanics
{
  namespace
  {
    // The four-point rule of degree 2 (Hammer and Stroud 1956): barycentric coordinate i
    // is a at point i and b at the others.
    constexpr double a = 0.58541019662496845446, b = 0.13819660112501051518;

    // The edge between vertices i and j, as the node's number in the cell; the vertex
    // itself for i = j.
    constexpr unsigned int pair[4][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}};

    /** The stress, row by row and times the weight, of the displacement gradient
     * G (row: component) in one lane. */
    template <typename Number, TangentForm form>
    struct Stress;

    /** The nine numbers of the symmetric stress (xx, yy, zz, yz, xz, xy). */
    template <typename Number>
    TETRADAPT_INLINE void
    to_rows(const Number *s, Number *rows)
    {
      rows[0] = s[0];
      rows[4] = s[1];
      rows[8] = s[2];
      rows[5] = rows[7] = s[3];
      rows[2] = rows[6] = s[4];
      rows[1] = rows[3] = s[5];
    }

    template <typename Number>
    struct Stress<Number, TangentForm::isotropic>
    {
      static TETRADAPT_INLINE void
      compute(const Number *tangent, unsigned int, const Number *G, Number *rows)
      {
        constexpr unsigned int W      = stiffness_lanes<Number>;
        const Number           lambda = tangent[0], mu = tangent[W];
        const Number           p = lambda * (G[0] + G[4] + G[8]), mu2 = mu + mu;
        const Number           s[6] = {p + mu2 * G[0],
                                       p + mu2 * G[4],
                                       p + mu2 * G[8],
                                       mu * (G[5] + G[7]),
                                       mu * (G[2] + G[6]),
                                       mu * (G[1] + G[3])};
        to_rows(s, rows);
      }
    };

    template <typename Number>
    TETRADAPT_INLINE void
    general_stress(const Number *D, const Number *G, Number *rows)
    {
      constexpr unsigned int W    = stiffness_lanes<Number>;
      const Number           e[6] = {G[0], G[4], G[8], G[5] + G[7], G[2] + G[6], G[1] + G[3]};
      Number                 s[6] = {0, 0, 0, 0, 0, 0};
      unsigned int           k    = 0;
#pragma GCC unroll 6
      for (unsigned int i = 0; i < 6; ++i)
#pragma GCC unroll 6
        for (unsigned int j = i; j < 6; ++j, ++k)
          {
            s[i] += D[k * W] * e[j];
            if (i != j)
              s[j] += D[k * W] * e[i];
          }
      to_rows(s, rows);
    }

    /** P = A : G with the upper triangle of A. */
    template <typename Number>
    TETRADAPT_INLINE void
    full_stress(const Number *A, const Number *G, Number *rows)
    {
      constexpr unsigned int W = stiffness_lanes<Number>;
#pragma GCC unroll 9
      for (unsigned int i = 0; i < 9; ++i)
        rows[i] = 0;
      unsigned int k = 0;
#pragma GCC unroll 9
      for (unsigned int i = 0; i < 9; ++i)
#pragma GCC unroll 9
        for (unsigned int j = i; j < 9; ++j, ++k)
          {
            rows[i] += A[k * W] * G[j];
            if (i != j)
              rows[j] += A[k * W] * G[i];
          }
    }

    template <typename Number>
    struct Stress<Number, TangentForm::one_per_cell>
    {
      static TETRADAPT_INLINE void
      compute(const Number *tangent, unsigned int, const Number *G, Number *s)
      {
        general_stress(tangent, G, s);
      }
    };

    template <typename Number>
    struct Stress<Number, TangentForm::four_per_cell>
    {
      static TETRADAPT_INLINE void
      compute(const Number *tangent, unsigned int q, const Number *G, Number *s)
      {
        general_stress(tangent + 21 * q * stiffness_lanes<Number>, G, s);
      }
    };

    template <typename Number>
    struct Stress<Number, TangentForm::full_per_point>
    {
      static TETRADAPT_INLINE void
      compute(const Number *tangent, unsigned int q, const Number *G, Number *rows)
      {
        full_stress(tangent + 45 * q * stiffness_lanes<Number>, G, rows);
      }
    };

    /**
     * The forces of one batch. With all four barycentric coordinates as variables, the
     * derivative of a quadratic function by coordinate i at point q is
     *   4 b (u_i + sum_j u_ij) - u_i + 4 (a - b) u_iq,   u_ii = u_i,
     * a part common to all points and one node's value.
     */
    template <typename Number, TangentForm form>
    TETRADAPT_INLINE void
    cell_forces(const Number *__restrict u,
                const Number *__restrict gradients,
                const Number *__restrict tangents,
                Number *__restrict f)
    {
      constexpr unsigned int W  = stiffness_lanes<Number>;
      constexpr Number       b4 = 4. * b, k = 4. * (a - b);
#pragma GCC ivdep
      for (unsigned int l = 0; l < W; ++l)
        {
          Number g[9], common[4][3], sums[4][3], forces[10][3];
#pragma GCC unroll 9
          for (unsigned int i = 0; i < 9; ++i)
            g[i] = gradients[i * W + l];
#pragma GCC unroll 4
          for (unsigned int i = 0; i < 4; ++i)
#pragma GCC unroll 3
            for (unsigned int c = 0; c < 3; ++c)
              {
                Number sum = 0;
#pragma GCC unroll 4
                for (unsigned int j = 0; j < 4; ++j)
                  sum += u[(3 * pair[i][j] + c) * W + l];
                common[i][c] = b4 * sum - u[(3 * i + c) * W + l];
                sums[i][c]   = 0;
              }
#pragma GCC unroll 10
          for (unsigned int n = 0; n < 10; ++n)
#pragma GCC unroll 3
            for (unsigned int c = 0; c < 3; ++c)
              forces[n][c] = 0;
#pragma GCC unroll 4
          for (unsigned int q = 0; q < 4; ++q)
            {
              Number G[9], s[9];
#pragma GCC unroll 3
              for (unsigned int c = 0; c < 3; ++c)
                {
                  const Number d0 = common[0][c] + k * u[(3 * pair[0][q] + c) * W + l];
                  const Number d1 = common[1][c] + k * u[(3 * pair[1][q] + c) * W + l] - d0;
                  const Number d2 = common[2][c] + k * u[(3 * pair[2][q] + c) * W + l] - d0;
                  const Number d3 = common[3][c] + k * u[(3 * pair[3][q] + c) * W + l] - d0;
#pragma GCC unroll 3
                  for (unsigned int x = 0; x < 3; ++x)
                    G[3 * c + x] = d1 * g[x] + d2 * g[3 + x] + d3 * g[6 + x];
                }
              Stress<Number, form>::compute(tangents + l, q, G, s);
#pragma GCC unroll 3
              for (unsigned int c = 0; c < 3; ++c)
                {
                  Number t[4];
#pragma GCC unroll 3
                  for (unsigned int i = 0; i < 3; ++i)
                    t[i + 1] = s[3 * c] * g[3 * i] + s[3 * c + 1] * g[3 * i + 1]
                               + s[3 * c + 2] * g[3 * i + 2];
                  t[0] = -(t[1] + t[2] + t[3]);
#pragma GCC unroll 4
                  for (unsigned int i = 0; i < 4; ++i)
                    {
                      sums[i][c] += t[i];
                      forces[pair[i][q]][c] += k * t[i];
                    }
                }
            }
#pragma GCC unroll 3
          for (unsigned int c = 0; c < 3; ++c)
            {
#pragma GCC unroll 4
              for (unsigned int i = 0; i < 4; ++i)
                {
                  forces[i][c] -= sums[i][c];
#pragma GCC unroll 4
                  for (unsigned int j = 0; j < 4; ++j)
                    forces[pair[i][j]][c] += b4 * sums[i][c];
                }
#pragma GCC unroll 10
              for (unsigned int n = 0; n < 10; ++n)
                f[(3 * n + c) * W + l] = forces[n][c];
            }
        }
    }

    template <typename Number, TangentForm form>
    TETRADAPT_INLINE void
    apply(const StiffnessBatches<Number> &batches,
          unsigned int                    begin,
          unsigned int                    end,
          const Number                   *x,
          Number                         *y)
    {
      constexpr unsigned int W = stiffness_lanes<Number>;
      alignas(64) Number     u[30 * W], f[30 * W];
      for (unsigned int batch = begin; batch < end; ++batch)
        {
          const unsigned int *nodes = batches.nodes + 10 * W * std::size_t(batch);
          if (batches.at_end[batch] != 0)
            for (unsigned int n = 0; n < 10; ++n)
              gather_at_end(x, nodes + n * W, u + 3 * n * W);
          else
            for (unsigned int n = 0; n < 10; ++n)
              gather(x, nodes + n * W, u + 3 * n * W);
          cell_forces<Number, form>(u,
                                    batches.gradients + 9 * W * std::size_t(batch),
                                    batches.tangents + tangent_size(form) * W * std::size_t(batch),
                                    f);
          for (unsigned int n = 0; n < 10; ++n)
            scatter(f + 3 * n * W, nodes + n * W, y);
        }
    }

    /** Derivatives of the ten shape functions by the four barycentric coordinates, as if
     * those were independent, at the four points. */
    struct ShapeDerivatives
    {
      constexpr ShapeDerivatives() : values{}
      {
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int q = 0; q < 4; ++q)
            for (unsigned int j = 0; j < 4; ++j)
              values[pair[i][j]][q][i]
                += i == j ? 4. * (i == q ? a : b) - 1. : 4. * (j == q ? a : b);
      }
      double values[10][4][4];
    };
    constexpr ShapeDerivatives shape_derivatives;

    /** The own block of node @p n of a batch. */
    template <typename Number, TangentForm form>
    TETRADAPT_INLINE void
    node_block(unsigned int n,
               const Number *__restrict gradients,
               const Number *__restrict tangents,
               Number *__restrict block)
    {
      constexpr unsigned int W = stiffness_lanes<Number>;
#pragma GCC ivdep
      for (unsigned int l = 0; l < W; ++l)
        {
          Number sum[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
#pragma GCC unroll 4
          for (unsigned int q = 0; q < 4; ++q)
            {
              const double(&d)[4] = shape_derivatives.values[n][q];
              const Number d1 = d[1] - d[0], d2 = d[2] - d[0], d3 = d[3] - d[0];
              Number       h[3];
#pragma GCC unroll 3
              for (unsigned int x = 0; x < 3; ++x)
                h[x] = d1 * gradients[x * W + l] + d2 * gradients[(3 + x) * W + l]
                       + d3 * gradients[(6 + x) * W + l];
#pragma GCC unroll 3
              for (unsigned int c = 0; c < 3; ++c)
                {
                  Number G[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0}, s[9];
#pragma GCC unroll 3
                  for (unsigned int x = 0; x < 3; ++x)
                    G[3 * c + x] = h[x];
                  Stress<Number, form>::compute(tangents + l, q, G, s);
                  sum[c] += s[0] * h[0] + s[1] * h[1] + s[2] * h[2];
                  sum[3 + c] += s[3] * h[0] + s[4] * h[1] + s[5] * h[2];
                  sum[6 + c] += s[6] * h[0] + s[7] * h[1] + s[8] * h[2];
                }
            }
#pragma GCC unroll 9
          for (unsigned int i = 0; i < 9; ++i)
            block[i * W + l] = sum[i];
        }
    }

    template <typename Number, TangentForm form>
    TETRADAPT_INLINE void
    add_blocks(const StiffnessBatches<Number> &batches,
               unsigned int                    begin,
               unsigned int                    end,
               Number                         *blocks)
    {
      constexpr unsigned int W = stiffness_lanes<Number>;
      alignas(64) Number     block[9 * W];
      for (unsigned int batch = begin; batch < end; ++batch)
        for (unsigned int n = 0; n < 10; ++n)
          {
            node_block<Number, form>(n,
                                     batches.gradients + 9 * W * std::size_t(batch),
                                     batches.tangents + tangent_size(form) * W * std::size_t(batch),
                                     block);
            const unsigned int *nodes = batches.nodes + W * (10 * std::size_t(batch) + n);
            for (unsigned int l = 0; l < W; ++l)
              for (unsigned int i = 0; i < 9; ++i)
                blocks[9 * std::size_t(nodes[l]) + i] += block[i * W + l];
          }
    }

// One set of clones for each number and form of tangents.
#define TETRADAPT_KERNELS(Number, form)                                                            \
  TETRADAPT_CLONES void apply_##Number##_##form(const StiffnessBatches<Number> &b,                 \
                                                unsigned int                    begin,             \
                                                unsigned int                    end,               \
                                                const Number                   *x,                 \
                                                Number                         *y)                 \
  {                                                                                                \
    apply<Number, TangentForm::form>(b, begin, end, x, y);                                         \
  }                                                                                                \
  TETRADAPT_CLONES void blocks_##Number##_##form(const StiffnessBatches<Number> &b,                \
                                                 unsigned int                    begin,            \
                                                 unsigned int                    end,              \
                                                 Number                         *to)               \
  {                                                                                                \
    add_blocks<Number, TangentForm::form>(b, begin, end, to);                                      \
  }
    TETRADAPT_KERNELS(double, isotropic)
    TETRADAPT_KERNELS(double, one_per_cell)
    TETRADAPT_KERNELS(double, four_per_cell)
    TETRADAPT_KERNELS(double, full_per_point)
    TETRADAPT_KERNELS(float, isotropic)
    TETRADAPT_KERNELS(float, one_per_cell)
    TETRADAPT_KERNELS(float, four_per_cell)
    TETRADAPT_KERNELS(float, full_per_point)
  } // namespace

#define TETRADAPT_DISPATCH(Number)                                                                 \
  template <>                                                                                      \
  void apply_stiffness(const StiffnessBatches<Number> &b,                                          \
                       unsigned int                    begin,                                      \
                       unsigned int                    end,                                        \
                       const Number                   *x,                                          \
                       Number                         *y)                                          \
  {                                                                                                \
    if (b.form == TangentForm::isotropic)                                                          \
      apply_##Number##_isotropic(b, begin, end, x, y);                                             \
    else if (b.form == TangentForm::one_per_cell)                                                  \
      apply_##Number##_one_per_cell(b, begin, end, x, y);                                          \
    else if (b.form == TangentForm::four_per_cell)                                                 \
      apply_##Number##_four_per_cell(b, begin, end, x, y);                                         \
    else                                                                                           \
      apply_##Number##_full_per_point(b, begin, end, x, y);                                        \
  }                                                                                                \
  template <>                                                                                      \
  void add_diagonal_blocks(const StiffnessBatches<Number> &b,                                      \
                           unsigned int                    begin,                                  \
                           unsigned int                    end,                                    \
                           Number                         *to)                                     \
  {                                                                                                \
    if (b.form == TangentForm::isotropic)                                                          \
      blocks_##Number##_isotropic(b, begin, end, to);                                              \
    else if (b.form == TangentForm::one_per_cell)                                                  \
      blocks_##Number##_one_per_cell(b, begin, end, to);                                           \
    else if (b.form == TangentForm::four_per_cell)                                                 \
      blocks_##Number##_four_per_cell(b, begin, end, to);                                          \
    else                                                                                           \
      blocks_##Number##_full_per_point(b, begin, end, to);                                         \
  }
  TETRADAPT_DISPATCH(double)
  TETRADAPT_DISPATCH(float)
} // namespace tetradapt::mechanics
