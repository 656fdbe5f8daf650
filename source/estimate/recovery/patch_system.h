// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_recovery_patch_system_h
#define tetradapt_estimate_recovery_patch_system_h

#include "patch_moments.h"
#include "stress_conditions.h"

namespace tetradapt::estimate
{
  /**
   * The equations of one patch of PatchSolver, which says what they are, in plain arrays. All
   * that it does is to be part of a function that is compiled for wide vectors (core/clones.h).
   */
  template <unsigned int degree>
  class PatchSystem
  {
  public:
    static constexpr unsigned int n = n_monomials[degree];

    /** A boundary face of the patch: what StressConditions::Face has. */
    struct Face
    {
      const double *matrix;     ///< 6 x 6
      const double *points;     ///< three numbers each
      const double (*right)[6]; ///< at each point
      unsigned int n_points;
      unsigned int plane; ///< its number in the patch; faces are sorted by it
    };

    /** What is given. */
    struct Input
    {
      PatchSamples  samples;
      double        center[3];
      const Face   *faces          = nullptr; ///< of patches at the boundary
      unsigned int  n_faces        = 0;
      const double *forces         = nullptr; ///< body force, three numbers a cell; null: none
      bool          has_conditions = false;
      bool          on_boundary    = false;
      /** Between components, without a unit; see PatchSolver. */
      double metric[6][6], inverse_metric[6][6];
    };

    /** @return false if the samples do not determine the polynomial well. */
    TETRADAPT_INLINE bool
    solve(Input &input)
    {
      fit.collect(input.samples, input.center);
      factor.clear();
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          factor.column(i)[j] = fit.moments[i][j];
      if (!factor.factorize(determined))
        return false;
      if (degree > 0 && input.has_conditions)
        collect_equilibrium(input);
      if (!(degree > 0 && input.on_boundary && solve_at_boundary(input)))
        solve_inside(input);
      return true;
    }

    PatchMoments<degree> fit;
    double               solution[6][n]; ///< coefficients in the fit's coordinates

  private:
    /** Monomials of degree p-1, in which the residual of equilibrium is. */
    static constexpr unsigned int n_lower   = n_monomials[degree == 0 ? 0 : degree - 1];
    static constexpr unsigned int n_all     = 6 * n;
    static constexpr unsigned int n_vectors = PatchMoments<degree>::n_vectors;

    using Lanes = core::Lanes;
    using Inner = LaneCholesky<n_lower>;
    using Schur = LaneCholesky<3 * n_lower>;
    using All   = LaneCholesky<n_all>;

    /** smallest_pivot of the factorisation for the samples of a patch. */
    static constexpr double determined = 1e-6;

    /**
     * Derivatives of the monomials of degree 1 or 2: monomial r of the lower degree in the
     * derivative by x_j comes from this one alone, times a factor.
     */
    struct Derivative
    {
      unsigned int of;
      double       factor;
    };
    static constexpr Derivative derivatives[3][4] = {{{1, 1.}, {4, 2.}, {7, 1.}, {9, 1.}},
                                                     {{2, 1.}, {7, 1.}, {5, 2.}, {8, 1.}},
                                                     {{3, 1.}, {9, 1.}, {8, 1.}, {6, 2.}}};

    /** The number of stress (i,j), as stress_index. */
    static constexpr unsigned int component[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};

    /** The weights of the residual of equilibrium at the cells' centroids, and what it
     * should be. */
    TETRADAPT_INLINE void
    collect_equilibrium(Input &input)
    {
      for (unsigned int i = 0; i < n_lower; ++i)
        {
          for (unsigned int j = 0; j < n_lower; ++j)
            weights[i][j] = 0.;
          for (unsigned int d = 0; d < 3; ++d)
            targets[d][i] = 0.;
        }
      const unsigned int n_a_cell = input.samples.n_a_cell;
      const double       share    = fit.scale / n_a_cell;
      const double      *x[3] = {input.samples.row(0), input.samples.row(1), input.samples.row(2)};
      for (unsigned int k = 0; k < input.samples.n_samples; k += n_a_cell)
        {
          // A cell's centroid is the mean of its points.
          double centroid[3] = {0., 0., 0.}, m[n_lower];
          for (unsigned int q = 0; q < n_a_cell; ++q)
            for (unsigned int d = 0; d < 3; ++d)
              centroid[d] += share * x[d][k + q];
          monomials<degree == 0 ? 0 : degree - 1>(centroid[0], centroid[1], centroid[2], m);
          for (unsigned int i = 0; i < n_lower; ++i)
            for (unsigned int j = 0; j < n_lower; ++j)
              weights[i][j] += StressConditions::inner_weight * m[i] * m[j];
          if (input.forces != nullptr)
            for (unsigned int d = 0; d < 3; ++d)
              for (unsigned int i = 0; i < n_lower; ++i)
                targets[d][i] -= StressConditions::inner_weight * fit.length
                                 * input.forces[3 * (k / n_a_cell) + d] * m[i];
        }
    }

    /** Sets solution to the inverse times right-hand sides, in whole vectors. */
    TETRADAPT_INLINE void
    apply_inverse(const double (&sides)[6][n])
    {
      for (unsigned int a = 0; a < 6; ++a)
        {
          alignas(64) Lanes sums[n_vectors];
          for (unsigned int v = 0; v < n_vectors; ++v)
            sums[v] = Lanes{};
          for (unsigned int k = 0; k < n; ++k)
            for (unsigned int v = 0; v < n_vectors; ++v)
              sums[v] += sides[a][k] * inverse[k][v];
          for (unsigned int i = 0; i < n; ++i)
            solution[a][i] = reinterpret_cast<const double *>(sums)[i];
        }
    }

    /** Fits to the samples alone, then corrects that so that the residual of equilibrium
     * counts, too, unless that is not determined. */
    TETRADAPT_INLINE void
    solve_inside(Input &input)
    {
      factor.invert(inverse);
      apply_inverse(fit.right);
      if (degree > 0 && input.has_conditions && correct_right(input))
        apply_inverse(fit.right);
    }

    /** Corrects the right-hand sides by the multipliers of equilibrium; false: they are not
     * determined. */
    TETRADAPT_INLINE bool
    correct_right(const Input &input)
    {
      Inner             inner;
      alignas(64) Lanes inverse_weights[n_lower][1];
      inner.clear();
      for (unsigned int i = 0; i < n_lower; ++i)
        for (unsigned int j = 0; j < n_lower; ++j)
          inner.column(i)[j] = weights[i][j];
      if (!inner.factorize(1e-10))
        return false; // cells in a plane: the fit to the samples is all there is
      inner.invert(inverse_weights);

      alignas(64) Lanes multiplier_lanes[Schur::n_vectors];
      for (unsigned int v = 0; v < Schur::n_vectors; ++v)
        multiplier_lanes[v] = Lanes{};
      auto *multipliers = reinterpret_cast<double *>(multiplier_lanes);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int r = 0; r < n_lower; ++r)
          {
            double sum = 0.;
            for (unsigned int s = 0; s < n_lower; ++s)
              sum -= reinterpret_cast<const double *>(inverse_weights[r])[s] * targets[i][s];
            for (unsigned int j = 0; j < 3; ++j)
              sum += derivatives[j][r].factor * solution[component[i][j]][derivatives[j][r].of];
            multipliers[n_lower * i + r] = sum;
          }
      Schur schur;
      find_schur(input, inverse_weights, schur);
      if (!schur.factorize(1e-14))
        return false;
      schur.solve(multipliers);

      double sides[6][n] = {}; // the transposed equations times the multipliers
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int r = 0; r < n_lower; ++r)
            sides[component[i][j]][derivatives[j][r].of]
              += derivatives[j][r].factor * multipliers[n_lower * i + r];
      for (unsigned int a = 0; a < 6; ++a)
        for (unsigned int b = 0; b < 6; ++b)
          if (input.inverse_metric[a][b] != 0.)
            for (unsigned int m = 0; m < n; ++m)
              fit.right[a][m] -= input.inverse_metric[a][b] * sides[b][m];
      return true;
    }

    /** The matrix for the multipliers: inverse weights and G B G^T. */
    TETRADAPT_INLINE void
    find_schur(const Input &input, const Lanes (&inverse_weights)[n_lower][1], Schur &schur)
    {
      // D_j A^-1 D_l^T, D_j the derivative by x_j
      double slopes[3][3][n_lower][n_lower];
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int l = 0; l < 3; ++l)
          for (unsigned int r = 0; r < n_lower; ++r)
            {
              const Derivative &first = derivatives[j][r];
              const auto       *row   = reinterpret_cast<const double *>(inverse[first.of]);
              for (unsigned int s = 0; s < n_lower; ++s)
                slopes[j][l][r][s]
                  = first.factor * derivatives[l][s].factor * row[derivatives[l][s].of];
            }
      // Equation i is the sum over j of the derivatives of component (i,j) by x_j.
      schur.clear();
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int i = k; i < 3; ++i)
          {
            double sum[n_lower][n_lower] = {};
            if (i == k)
              for (unsigned int r = 0; r < n_lower; ++r)
                for (unsigned int s = 0; s < n_lower; ++s)
                  sum[r][s] = reinterpret_cast<const double *>(inverse_weights[r])[s];
            for (unsigned int j = 0; j < 3; ++j)
              for (unsigned int l = 0; l < 3; ++l)
                if (const double f = input.inverse_metric[component[i][j]][component[k][l]];
                    f != 0.)
                  for (unsigned int s = 0; s < n_lower; ++s)
                    for (unsigned int r = 0; r < n_lower; ++r)
                      sum[s][r] += f * slopes[l][j][s][r];
            for (unsigned int s = 0; s < n_lower; ++s)
              for (unsigned int r = 0; r < n_lower; ++r)
                schur.column(n_lower * k + s)[n_lower * i + r] = sum[s][r];
          }
    }

    TETRADAPT_INLINE bool
    solve_at_boundary(Input &input)
    {
      matrix.clear();
      for (unsigned int v = 0; v < All::n_vectors; ++v)
        right[v] = Lanes{};
      auto    *sides = reinterpret_cast<double *>(right);
      Products products;
      begin_matrix(products, &input.metric[0][0]);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          reinterpret_cast<double *>(products.of_monomials[0][i])[j] = fit.moments[i][j];
      for (unsigned int b = 0; b < 6; ++b)
        for (unsigned int a = 0; a < 6; ++a)
          if (input.metric[a][b] != 0.)
            for (unsigned int i = 0; i < n; ++i)
              sides[n * a + i] += input.metric[a][b] * fit.right[b][i];
      add_faces(input, products);
      add_products(products);
      add_equilibrium();
      if (!matrix.factorize(1e-3 * determined))
        return false;
      matrix.solve(sides);
      for (unsigned int a = 0; a < 6; ++a)
        for (unsigned int i = 0; i < n; ++i)
          solution[a][i] = sides[n * a + i];
      return true;
    }

    /** Matrices between components and, for each, one between monomials, to be multiplied. */
    struct Products
    {
      static constexpr unsigned int capacity = 8;

      alignas(64) Lanes of_monomials[capacity][n][n_vectors];
      const double *of_components[capacity];
      unsigned int  size = 0;
    };

    /** Adds the products to the matrix for all coefficients and forgets them. */
    TETRADAPT_INLINE void
    add_products(Products &products)
    {
      for (unsigned int b = 0; b < 6; ++b)
        for (unsigned int a = b; a < 6; ++a)
          for (unsigned int j = 0; j < n; ++j)
            {
              alignas(64) Lanes sums[n_vectors];
              for (unsigned int v = 0; v < n_vectors; ++v)
                sums[v] = Lanes{};
              for (unsigned int p = 0; p < products.size; ++p)
                for (unsigned int v = 0; v < n_vectors; ++v)
                  sums[v] += products.of_components[p][6 * a + b] * products.of_monomials[p][j][v];
              double *column = matrix.column(n * b + j) + n * a;
              for (unsigned int v = 0; v < n_vectors; ++v)
                for (unsigned int l = 0; l < core::n_lanes && core::n_lanes * v + l < n; ++l)
                  column[core::n_lanes * v + l] += sums[v][l];
            }
      products.size = 0;
    }

    /** Makes room for the monomials' products of a matrix between components. */
    TETRADAPT_INLINE void
    begin_matrix(Products &products, const double *of_components)
    {
      if (products.size == Products::capacity)
        add_products(products);
      products.of_components[products.size] = of_components;
      clear(products.of_monomials[products.size]);
      ++products.size;
    }

    /** Faces in one plane and with the same conditions have the same matrix: what is common
     * to the components is summed up first. Monomials fill whole vectors. */
    TETRADAPT_INLINE void
    add_faces(const Input &input, Products &products)
    {
      alignas(64) Lanes sums[6][n_vectors];
      clear(sums);
      for (const Face *face = input.faces; face != input.faces + input.n_faces; ++face)
        {
          if (face == input.faces || face->plane != (face - 1)->plane)
            begin_matrix(products, face->matrix);
          auto &squares = products.of_monomials[products.size - 1];
          for (unsigned int q = 0; q < face->n_points; ++q)
            {
              alignas(64) double m[n_vectors * core::n_lanes] = {};
              monomials<degree>(fit.scale * (face->points[3 * q] - input.center[0]),
                                fit.scale * (face->points[3 * q + 1] - input.center[1]),
                                fit.scale * (face->points[3 * q + 2] - input.center[2]),
                                m);
              const auto *rows = reinterpret_cast<const Lanes *>(m);
              for (unsigned int v = 0; v < n_vectors; ++v)
                {
                  for (unsigned int i = 0; i < n; ++i)
                    squares[i][v] += m[i] * rows[v];
                  for (unsigned int a = 0; a < 6; ++a)
                    sums[a][v] += face->right[q][a] * rows[v];
                }
            }
        }
      auto *sides = reinterpret_cast<double *>(right);
      for (unsigned int a = 0; a < 6; ++a)
        for (unsigned int i = 0; i < n; ++i)
          sides[n * a + i] += reinterpret_cast<const double *>(sums[a])[i];
    }

    template <unsigned int size>
    TETRADAPT_INLINE static void
    clear(Lanes (&rows)[size][n_vectors])
    {
      for (unsigned int i = 0; i < size; ++i)
        for (unsigned int v = 0; v < n_vectors; ++v)
          rows[i][v] = Lanes{};
    }

    TETRADAPT_INLINE void
    add_equilibrium()
    {
      auto *sides = reinterpret_cast<double *>(right);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int r = 0; r < n_lower; ++r)
            {
              const Derivative  &first  = derivatives[j][r];
              const unsigned int k      = n * component[i][j] + first.of;
              double            *column = matrix.column(k);
              sides[k] += first.factor * targets[i][r];
              // What comes to lie above the diagonal has no meaning there.
              for (unsigned int l = 0; l < 3; ++l)
                for (unsigned int s = 0; s < n_lower; ++s)
                  column[n * component[i][l] + derivatives[l][s].of]
                    += first.factor * derivatives[l][s].factor * weights[r][s];
            }
    }

    LaneCholesky<n> factor;                  ///< of the moments
    alignas(64) Lanes inverse[n][n_vectors]; ///< of the moments
    double weights[n_lower][n_lower];        ///< of the residual of equilibrium
    double targets[3][n_lower];              ///< weights times -f length, as a polynomial
    All    matrix;                           ///< for all coefficients together
    alignas(64) Lanes right[All::n_vectors];
  };
} // namespace tetradapt::estimate

#endif
