// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_patch_system_h
#define tetradapt_compare_patch_system_h

#include "tetradapt/compare/patch_moments.h"
#include "tetradapt/compare/stress_conditions.h"

namespace tetradapt::compare
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
      bool         begins; ///< a matrix that is not the last face's
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
          Lanes sums[n_vectors];
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
      Inner inner;
      Lanes inverse_weights[n_lower][1];
      inner.clear();
      for (unsigned int i = 0; i < n_lower; ++i)
        for (unsigned int j = 0; j < n_lower; ++j)
          inner.column(i)[j] = weights[i][j];
      if (!inner.factorize(1e-10))
        return false; // cells in a plane: the fit to the samples is all there is
      inner.invert(inverse_weights);

      Lanes multiplier_lanes[Schur::n_vectors];
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
      auto *sides = reinterpret_cast<double *>(right);
      add_matrix(&input.metric[0][0], fit.moments);
      for (unsigned int b = 0; b < 6; ++b)
        for (unsigned int a = 0; a < 6; ++a)
          if (input.metric[a][b] != 0.)
            for (unsigned int i = 0; i < n; ++i)
              sides[n * a + i] += input.metric[a][b] * fit.right[b][i];
      add_faces(input);
      add_equilibrium();
      if (!matrix.factorize(1e-3 * determined))
        return false;
      matrix.solve(sides);
      for (unsigned int a = 0; a < 6; ++a)
        for (unsigned int i = 0; i < n; ++i)
          solution[a][i] = sides[n * a + i];
      return true;
    }

    /** Adds a matrix between components times one between monomials. */
    TETRADAPT_INLINE void
    add_matrix(const double *of_components, const double (&of_monomials)[n][n])
    {
      for (unsigned int b = 0; b < 6; ++b)
        for (unsigned int a = b; a < 6; ++a)
          if (const double f = of_components[6 * a + b]; f != 0.)
            for (unsigned int j = 0; j < n; ++j)
              {
                double *column = matrix.column(n * b + j) + n * a;
                for (unsigned int i = 0; i < n; ++i)
                  column[i] += f * of_monomials[j][i];
              }
    }

    TETRADAPT_INLINE void
    add_faces(const Input &input)
    {
      // Faces in one plane and with the same conditions have the same matrix: what is common
      // to the components is summed up first.
      double products[n][n] = {};
      auto  *sides          = reinterpret_cast<double *>(right);
      for (const Face *face = input.faces; face != input.faces + input.n_faces; ++face)
        {
          if (face->begins && face != input.faces)
            {
              add_matrix((face - 1)->matrix, products);
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int j = 0; j < n; ++j)
                  products[i][j] = 0.;
            }
          for (unsigned int q = 0; q < face->n_points; ++q)
            {
              double m[n];
              monomials<degree>(fit.scale * (face->points[3 * q] - input.center[0]),
                                fit.scale * (face->points[3 * q + 1] - input.center[1]),
                                fit.scale * (face->points[3 * q + 2] - input.center[2]),
                                m);
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int j = 0; j < n; ++j)
                  products[i][j] += m[i] * m[j];
              for (unsigned int a = 0; a < 6; ++a)
                for (unsigned int i = 0; i < n; ++i)
                  sides[n * a + i] += face->right[q][a] * m[i];
            }
        }
      if (input.n_faces > 0)
        add_matrix(input.faces[input.n_faces - 1].matrix, products);
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

    LaneCholesky<n> factor;                    ///< of the moments
    Lanes           inverse[n][n_vectors];     ///< of the moments
    double          weights[n_lower][n_lower]; ///< of the residual of equilibrium
    double          targets[3][n_lower];       ///< weights times -f length, as a polynomial
    All             matrix;                    ///< for all coefficients together
    Lanes           right[All::n_vectors];
  };
} // namespace tetradapt::compare

#endif
