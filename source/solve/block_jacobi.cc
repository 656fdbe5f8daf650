// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/block_jacobi.h"

#include "tetradapt/core/clones.h"

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    /** Inverts in place by Gauss and Jordan's method without pivots, which positive blocks
     * do not need; false if a pivot is not positive next to the diagonal. */
    template <typename Number, unsigned int n>
    bool
    invert(std::array<Number, n * n> &block)
    {
      std::array<double, n * n> m;
      std::copy(block.begin(), block.end(), m.begin());
      for (unsigned int p = 0; p < n; ++p)
        {
          const double pivot = m[p * n + p];
          if (!(pivot > 1e-6 * block[p * n + p]))
            return false;
          m[p * n + p] = 1.;
          for (unsigned int j = 0; j < n; ++j)
            m[p * n + j] /= pivot;
          for (unsigned int i = 0; i < n; ++i)
            if (i != p)
              {
                const double factor = m[i * n + p];
                m[i * n + p]        = 0.;
                for (unsigned int j = 0; j < n; ++j)
                  m[i * n + j] -= factor * m[p * n + j];
              }
        }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          block[i * n + j] = 0.5 * (m[i * n + j] + m[j * n + i]);
      return true;
    }

    template <typename Number>
    constexpr unsigned int lanes = 64 / sizeof(Number);

    /** What a step does apart from reading: all of it; no direction before; only x. */
    enum class Kind
    {
      start, ///< from is b, and x becomes the direction
      first,
      middle,
      last,
      only
    };

    /** A step of @p count nodes of 3 x 3 blocks, of which @p m has a batch. */
    template <typename Number, Kind kind>
    TETRADAPT_INLINE void
    step_of_batch(unsigned int  count,
                  const Number *m,
                  Number        keep,
                  Number        factor,
                  const Number *from,
                  const Number *product,
                  Number       *r,
                  Number       *d,
                  Number       *x)
    {
      constexpr unsigned int W = lanes<Number>;
#pragma GCC ivdep
      for (unsigned int l = 0; l < count; ++l)
        {
          Number s0 = from[3 * l], s1 = from[3 * l + 1], s2 = from[3 * l + 2];
          if (kind != Kind::start)
            {
              s0 -= product[3 * l];
              s1 -= product[3 * l + 1];
              s2 -= product[3 * l + 2];
            }
          Number z0 = factor * (m[l] * s0 + m[W + l] * s1 + m[2 * W + l] * s2);
          Number z1 = factor * (m[W + l] * s0 + m[3 * W + l] * s1 + m[4 * W + l] * s2);
          Number z2 = factor * (m[2 * W + l] * s0 + m[4 * W + l] * s1 + m[5 * W + l] * s2);
          if (kind == Kind::middle || kind == Kind::last)
            {
              z0 += keep * d[3 * l];
              z1 += keep * d[3 * l + 1];
              z2 += keep * d[3 * l + 2];
            }
          if (kind == Kind::first || kind == Kind::middle)
            {
              r[3 * l]     = s0;
              r[3 * l + 1] = s1;
              r[3 * l + 2] = s2;
            }
          if (kind == Kind::first || kind == Kind::middle || kind == Kind::start)
            {
              d[3 * l]     = z0;
              d[3 * l + 1] = z1;
              d[3 * l + 2] = z2;
            }
          x[3 * l]     = kind == Kind::start ? z0 : x[3 * l] + z0;
          x[3 * l + 1] = kind == Kind::start ? z1 : x[3 * l + 1] + z1;
          x[3 * l + 2] = kind == Kind::start ? z2 : x[3 * l + 2] + z2;
        }
    }

    template <typename Number, Kind kind>
    TETRADAPT_INLINE void
    step_of_kind(std::size_t   n_nodes,
                 const Number *m,
                 Number        keep,
                 Number        factor,
                 const Number *from,
                 const Number *product,
                 Number       *r,
                 Number       *d,
                 Number       *x)
    {
      constexpr unsigned int W       = lanes<Number>;
      const std::size_t      n_whole = n_nodes / W;
      for (std::size_t batch = 0; batch < n_whole; ++batch)
        step_of_batch<Number, kind>(W,
                                    m + 6 * W * batch,
                                    keep,
                                    factor,
                                    from + 3 * W * batch,
                                    product + 3 * W * batch,
                                    r + 3 * W * batch,
                                    d + 3 * W * batch,
                                    x + 3 * W * batch);
      step_of_batch<Number, kind>(n_nodes % W,
                                  m + 6 * W * n_whole,
                                  keep,
                                  factor,
                                  from + 3 * W * n_whole,
                                  product + 3 * W * n_whole,
                                  r + 3 * W * n_whole,
                                  d + 3 * W * n_whole,
                                  x + 3 * W * n_whole);
    }

// Clones cannot be made of templates.
#define TETRADAPT_STEPS(Number)                                                                    \
  TETRADAPT_CLONES void step_of_threes(Kind          kind,                                         \
                                       std::size_t   n_nodes,                                      \
                                       const Number *m,                                            \
                                       Number        keep,                                         \
                                       Number        factor,                                       \
                                       const Number *from,                                         \
                                       const Number *product,                                      \
                                       Number       *r,                                            \
                                       Number       *d,                                            \
                                       Number       *x)                                            \
  {                                                                                                \
    if (kind == Kind::start)                                                                       \
      step_of_kind<Number, Kind::start>(n_nodes, m, keep, factor, from, product, r, d, x);         \
    else if (kind == Kind::first)                                                                  \
      step_of_kind<Number, Kind::first>(n_nodes, m, keep, factor, from, product, r, d, x);         \
    else if (kind == Kind::middle)                                                                 \
      step_of_kind<Number, Kind::middle>(n_nodes, m, keep, factor, from, product, r, d, x);        \
    else if (kind == Kind::last)                                                                   \
      step_of_kind<Number, Kind::last>(n_nodes, m, keep, factor, from, product, r, d, x);          \
    else                                                                                           \
      step_of_kind<Number, Kind::only>(n_nodes, m, keep, factor, from, product, r, d, x);          \
  }
    TETRADAPT_STEPS(float)
    TETRADAPT_STEPS(double)

    /** A step with blocks of any size. */
    template <typename Number, unsigned int n>
    void
    step_of_blocks(Kind          kind,
                   std::size_t   n_nodes,
                   const Number *m,
                   Number        keep,
                   Number        factor,
                   const Number *from,
                   const Number *product,
                   Number       *r,
                   Number       *d,
                   Number       *x)
    {
      for (std::size_t node = 0; node < n_nodes; ++node, m += n * n)
        {
          const std::size_t first = n * node;
          Number            s[n];
          for (unsigned int i = 0; i < n; ++i)
            s[i] = kind == Kind::start ? from[first + i] : from[first + i] - product[first + i];
          for (unsigned int i = 0; i < n; ++i)
            {
              Number z = 0;
              for (unsigned int j = 0; j < n; ++j)
                z += m[i * n + j] * s[j];
              z *= factor;
              if (kind == Kind::middle || kind == Kind::last)
                z += keep * d[first + i];
              if (kind != Kind::start)
                r[first + i] = s[i];
              d[first + i] = z;
              x[first + i] = kind == Kind::start ? z : x[first + i] + z;
            }
        }
    }

    template <typename Number, unsigned int n, typename... Arguments>
    void
    any_step(const Arguments &...arguments)
    {
      if constexpr (n == 3)
        step_of_threes(arguments...);
      else
        step_of_blocks<Number, n>(arguments...);
    }
  } // namespace

  template <typename Number, unsigned int n>
  std::vector<std::array<Number, n * n>>
  invert_blocks(const std::vector<std::array<Number, n * n>> &blocks)
  {
    auto inverses = blocks;
    for (std::size_t node = 0; node < blocks.size(); ++node)
      if (!invert<Number, n>(inverses[node]))
        {
          inverses[node].fill(0);
          for (unsigned int i = 0; i < n; ++i)
            if (blocks[node][i * (n + 1)] > 0)
              inverses[node][i * (n + 1)] = 1 / blocks[node][i * (n + 1)];
        }
    return inverses;
  }

  template <typename Number, unsigned int n>
  BlockJacobi<Number, n>::BlockJacobi(const std::vector<std::array<Number, n * n>> &inverses)
    : node_count(inverses.size())
  {
    if (n != 3)
      {
        entries.resize_fast(n * n * node_count);
        for (std::size_t node = 0; node < node_count; ++node)
          std::copy(inverses[node].begin(), inverses[node].end(), &entries[n * n * node]);
        return;
      }
    constexpr unsigned int W = lanes<Number>;
    entries.resize(6 * W * ((node_count + W - 1) / W));
    for (std::size_t node = 0; node < node_count; ++node)
      {
        Number *const to = &entries[6 * W * (node / W) + node % W];
        unsigned int  k  = 0;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = i; j < 3; ++j)
            to[W * k++] = inverses[node][3 * i + j];
      }
  }

  template <typename Number, unsigned int n>
  void
  BlockJacobi<Number, n>::start(double factor, const Number *b, Number *d, Number *x) const
  {
    any_step<Number, n>(Kind::start,
                        node_count,
                        static_cast<const Number *>(entries.data()),
                        Number(0),
                        static_cast<Number>(factor),
                        b,
                        b,
                        d, // the residual: not written
                        d,
                        x);
  }

  template <typename Number, unsigned int n>
  void
  BlockJacobi<Number, n>::step(const JacobiStep &step,
                               const Number     *from,
                               const Number     *product,
                               Number           *r,
                               Number           *d,
                               Number           *x) const
  {
    const bool is_first = step.keep == 0.;
    any_step<Number, n>(is_first ? (step.is_last ? Kind::only : Kind::first)
                                 : (step.is_last ? Kind::last : Kind::middle),
                        node_count,
                        static_cast<const Number *>(entries.data()),
                        static_cast<Number>(step.keep),
                        static_cast<Number>(step.factor),
                        from,
                        product,
                        r,
                        d,
                        x);
  }

  template std::vector<std::array<double, 9>>
  invert_blocks<double, 3>(const std::vector<std::array<double, 9>> &);
  template std::vector<std::array<double, 36>>
  invert_blocks<double, 6>(const std::vector<std::array<double, 36>> &);
  template std::vector<std::array<float, 9>>
  invert_blocks<float, 3>(const std::vector<std::array<float, 9>> &);
  template std::vector<std::array<float, 36>>
  invert_blocks<float, 6>(const std::vector<std::array<float, 36>> &);
  template class BlockJacobi<double, 3>;
  template class BlockJacobi<double, 6>;
  template class BlockJacobi<float, 3>;
  template class BlockJacobi<float, 6>;
} // namespace tetradapt::solve
