// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_enriched_bernstein_kernel_h
#define tetradapt_estimate_enriched_bernstein_kernel_h

#include "tetradapt/core/lanes.h"

namespace tetradapt::estimate
{
  using core::Lanes; // one number for each of eight cells
  using core::n_lanes;

  // Plain arrays throughout: a function compiled for several processors does not inline
  // std::array's operator[].

  /** Local edges of a tetrahedron whose vertices are sorted: from smaller to larger. */
  constexpr unsigned int sorted_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

  /**
   * The Bernstein polynomials of degree q on a tetrahedron, q!/alpha! b^alpha, numbered
   * vertices first, then along the edges, then in the faces. Their gradients
   * are sparse: the gradient of sum c_alpha B_alpha is sum_beta B_beta (of degree q - 1)
   * times q sum_i c_(beta + e_i) grad b_i.
   */
  template <unsigned int q>
  struct Bernstein
  {
    static constexpr unsigned int n = (q + 1) * (q + 2) * (q + 3) / 6; ///< polynomials
    static constexpr unsigned int m = q * (q + 1) * (q + 2) / 6;       ///< of degree q - 1

    struct Indices
    {
      unsigned int alpha[n][4];
    };
    struct Raised
    {
      unsigned int number[m][4]; ///< of beta + e_i
    };
    struct Mass
    {
      double mean[m][m]; ///< of products of two polynomials of degree q - 1
    };

    static constexpr Indices
    indices()
    {
      Indices      result{};
      unsigned int k = 0;
      if (q == 0)
        return result;
      for (unsigned int v = 0; v < 4; ++v)
        result.alpha[k++][v] = q;
      if (q > 1)
        for (unsigned int e = 0; e < 6; ++e)
          for (unsigned int s = 1; s < q; ++s, ++k)
            {
              result.alpha[k][sorted_edges[e][0]] = q - s;
              result.alpha[k][sorted_edges[e][1]] = s;
            }
      if (q > 2)
        for (unsigned int f = 0; f < 4; ++f, ++k)
          for (unsigned int v = 0; v < 4; ++v)
            result.alpha[k][v] = v == f ? 0 : 1;
      return result;
    }

    static constexpr Raised
    raised()
    {
      const auto upper = indices();
      const auto lower = Bernstein<q - 1>::indices();
      Raised     result{};
      for (unsigned int b = 0; b < m; ++b)
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int a = 0; a < n; ++a)
            {
              bool same = true;
              for (unsigned int v = 0; v < 4; ++v)
                same = same && upper.alpha[a][v] == lower.alpha[b][v] + (v == i ? 1 : 0);
              if (same)
                result.number[b][i] = a;
            }
      return result;
    }

    static constexpr double
    binomial(unsigned int upper, unsigned int lower)
    {
      double result = 1.;
      for (unsigned int i = 1; i <= lower; ++i)
        result *= static_cast<double>(upper - lower + i) / i;
      return result;
    }

    static constexpr Mass
    mass()
    {
      const auto lower = Bernstein<q - 1>::indices();
      Mass       result{};
      for (unsigned int a = 0; a < m; ++a)
        for (unsigned int b = 0; b < m; ++b)
          {
            double value = 1. / binomial(2 * (q - 1), q - 1) / binomial(2 * q + 1, 3);
            for (unsigned int v = 0; v < 4; ++v)
              value *= binomial(lower.alpha[a][v] + lower.alpha[b][v], lower.alpha[a][v]);
            result.mean[a][b] = value;
          }
      return result;
    }
  };

  /** Stiffness in Voigt order xx, yy, zz, yz, xz, xy for engineering shears. */
  struct VoigtMatrix
  {
    double value[6][6];
  };

  /** Geometry of eight cells of one material. */
  struct CellBatchGeometry
  {
    Lanes gradients[4][3]; ///< of the barycentric coordinates
    Lanes volume;
  };

  /**
   * forces = element stiffness times coefficients, both of Bernstein polynomials of degree
   * q, for eight cells at once.
   */
  template <unsigned int q>
  inline __attribute__((always_inline)) void
  multiply_stiffness(const CellBatchGeometry &geometry,
                     const VoigtMatrix       &D,
                     const Lanes (&coefficients)[Bernstein<q>::n][3],
                     Lanes (&forces)[Bernstein<q>::n][3])
  {
    constexpr unsigned int n      = Bernstein<q>::n;
    constexpr unsigned int m      = Bernstein<q>::m;
    constexpr auto         raised = Bernstein<q>::raised();
    constexpr auto         mass   = Bernstein<q>::mass();

    const auto &g = geometry.gradients;
    Lanes       stress[m][6];
    for (unsigned int b = 0; b < m; ++b)
      {
        Lanes e[6] = {};
        for (unsigned int i = 0; i < 4; ++i)
          {
            const auto &c = coefficients[raised.number[b][i]];
            e[0] += c[0] * g[i][0];
            e[1] += c[1] * g[i][1];
            e[2] += c[2] * g[i][2];
            e[3] += c[1] * g[i][2] + c[2] * g[i][1];
            e[4] += c[0] * g[i][2] + c[2] * g[i][0];
            e[5] += c[0] * g[i][1] + c[1] * g[i][0];
          }
        for (unsigned int i = 0; i < 6; ++i)
          {
            Lanes sum = D.value[i][0] * e[0];
            for (unsigned int j = 1; j < 6; ++j)
              sum += D.value[i][j] * e[j];
            stress[b][i] = sum;
          }
      }
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int c = 0; c < 3; ++c)
        forces[a][c] = Lanes{};
    const Lanes factor = geometry.volume * static_cast<double>(q * q);
    for (unsigned int b = 0; b < m; ++b)
      {
        Lanes s[6];
        for (unsigned int i = 0; i < 6; ++i)
          {
            Lanes sum = mass.mean[b][0] * stress[0][i];
            for (unsigned int k = 1; k < m; ++k)
              sum += mass.mean[b][k] * stress[k][i];
            s[i] = factor * sum;
          }
        for (unsigned int i = 0; i < 4; ++i)
          {
            auto &f = forces[raised.number[b][i]];
            f[0] += s[0] * g[i][0] + s[5] * g[i][1] + s[4] * g[i][2];
            f[1] += s[5] * g[i][0] + s[1] * g[i][1] + s[3] * g[i][2];
            f[2] += s[4] * g[i][0] + s[3] * g[i][1] + s[2] * g[i][2];
          }
      }
  }
} // namespace tetradapt::estimate

#endif
