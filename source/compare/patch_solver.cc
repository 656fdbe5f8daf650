// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/patch_solver.h"

#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/core/clones.h"

namespace tetradapt::compare
{
  namespace
  {
    /** smallest_pivot of factorize() for the samples of a patch. */
    constexpr double determined = 1e-6;

    /**
     * Derivatives of the monomials of degree 1 or 2: d m_i / dx_j = factor m_k. Each
     * gives one monomial or none.
     */
    struct Derivative
    {
      unsigned int of, to;
      double       factor;
    };
    constexpr Derivative derivatives[3][4] = {{{1, 0, 1.}, {4, 1, 2.}, {7, 2, 1.}, {9, 3, 1.}},
                                              {{2, 0, 1.}, {5, 2, 2.}, {7, 1, 1.}, {8, 3, 1.}},
                                              {{3, 0, 1.}, {6, 3, 2.}, {8, 2, 1.}, {9, 1, 1.}}};
    /** How many of them there are for a degree. */
    constexpr unsigned int n_derivatives[3] = {0, 1, 4};
  } // namespace

  template <unsigned int degree>
  PatchSolver<degree>::PatchSolver(const mesh::TetMesh             &mesh,
                                   const std::vector<StressSample> &samples,
                                   const unsigned int               n_a_cell,
                                   const CellMaterials             &materials,
                                   const StressConditions          *conditions)
    : mesh(mesh), samples(samples), n_a_cell(n_a_cell), materials(materials), conditions(conditions)
  {
  }

  template <unsigned int degree>
  TETRADAPT_CLONES void
  PatchSolver<degree>::collect(const Point<3> &center, const std::vector<unsigned int> &cells)
  {
    double square = 0.;
    for (const unsigned int cell : cells)
      for (unsigned int q = 0; q < n_a_cell; ++q)
        square = std::max(square,
                          (samples[std::size_t(cell) * n_a_cell + q].point - center).norm_square());
    length = std::sqrt(square);
    scale  = 1. / length;
    fit.clear();
    for (const unsigned int cell : cells)
      for (unsigned int q = 0; q < n_a_cell; ++q)
        {
          const StressSample &s = samples[std::size_t(cell) * n_a_cell + q];
          fit.add(scale * (s.point[0] - center[0]),
                  scale * (s.point[1] - center[1]),
                  scale * (s.point[2] - center[2]),
                  s.stress);
        }
  }

  template <unsigned int degree>
  void
  PatchSolver<degree>::set_metric(const ElasticMatrices &elastic)
  {
    const double modulus = 2. * elastic.shear_modulus;
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < 6; ++b)
        {
          metric[a][b]         = modulus * elastic.metric[a][b];
          inverse_metric[a][b] = elastic.inverse_metric[a][b] / modulus;
        }
  }

  template <unsigned int degree>
  TETRADAPT_CLONES void
  PatchSolver<degree>::collect_equilibrium(const Point<3>                  &center,
                                           const std::vector<unsigned int> &cells)
  {
    std::fill(&weights[0][0], &weights[0][0] + n_lower * n_lower, 0.);
    std::fill(&targets[0][0], &targets[0][0] + 3 * n_lower, 0.);
    for (const unsigned int cell : cells)
      {
        const Point<3> p = position(mesh, cell, {{.25, .25, .25, .25}});
        double         m[n_lower];
        monomials<degree == 0 ? 0 : degree - 1>(scale * (p[0] - center[0]),
                                                scale * (p[1] - center[1]),
                                                scale * (p[2] - center[2]),
                                                m);
        for (unsigned int i = 0; i < n_lower; ++i)
          for (unsigned int j = 0; j < n_lower; ++j)
            weights[i][j] += StressConditions::inner_weight * m[i] * m[j];
        if (!conditions->forces.empty())
          for (unsigned int d = 0; d < 3; ++d)
            for (unsigned int i = 0; i < n_lower; ++i)
              targets[d][i]
                -= StressConditions::inner_weight * length * conditions->forces[cell][d] * m[i];
      }
  }

  template <unsigned int degree>
  TETRADAPT_CLONES bool
  PatchSolver<degree>::invert_weights(InnerSystem &system)
  {
    double inverse_scale[n_lower];
    if (!factorize(weights, inverse_scale, 1e-10))
      return false;
    for (unsigned int i = 0; i < n_lower; ++i)
      {
        std::fill(system.inverse[i], system.inverse[i] + n_lower, 0.);
        system.inverse[i][i] = 1.;
        solve_factorized(weights, inverse_scale, system.inverse[i]);
      }
    for (auto &target : targets)
      solve_factorized(weights, inverse_scale, target);
    return true;
  }

  template <unsigned int degree>
  TETRADAPT_CLONES void
  PatchSolver<degree>::find_columns(InnerSystem &system) const
  {
    auto &columns = system.columns;
    std::fill(&columns[0][0][0], &columns[0][0][0] + 3 * n_lower * n, 0.);
    std::fill(&system.slopes[0][0][0][0], &system.slopes[0][0][0][0] + 9 * n_lower * n_lower, 0.);
    for (unsigned int j = 0; j < 3; ++j)
      {
        for (unsigned int k = 0; k < n_derivatives[degree]; ++k)
          columns[j][derivatives[j][k].to][derivatives[j][k].of] = derivatives[j][k].factor;
        for (unsigned int r = 0; r < n_lower; ++r)
          solve_factorized(factor, factor_scale, columns[j][r]);
        for (unsigned int l = 0; l < 3; ++l)
          for (unsigned int k = 0; k < n_derivatives[degree]; ++k)
            for (unsigned int r = 0; r < n_lower; ++r)
              system.slopes[l][j][derivatives[l][k].to][r]
                += derivatives[l][k].factor * columns[j][r][derivatives[l][k].of];
      }
  }

  template <unsigned int degree>
  TETRADAPT_CLONES bool
  PatchSolver<degree>::find_multipliers(const InnerSystem &system,
                                        double (&multipliers)[3 * n_lower]) const
  {
    // Equation i is the sum over j of the derivatives of component (i,j) by x_j.
    double schur[3 * n_lower][3 * n_lower], schur_scale[3 * n_lower];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int r = 0; r < n_lower; ++r)
        {
          for (unsigned int k = 0; k < 3; ++k)
            for (unsigned int s = 0; s < n_lower; ++s)
              {
                double sum = i == k ? system.inverse[r][s] : 0.;
                for (unsigned int j = 0; j < 3; ++j)
                  for (unsigned int l = 0; l < 3; ++l)
                    sum += inverse_metric[stress_index[i][j]][stress_index[k][l]]
                           * system.slopes[j][l][r][s];
                schur[n_lower * i + r][n_lower * k + s] = sum;
              }
          multipliers[n_lower * i + r] = -targets[i][r];
        }
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int k = 0; k < n_derivatives[degree]; ++k)
          multipliers[n_lower * i + derivatives[j][k].to]
            += derivatives[j][k].factor * solution[stress_index[i][j]][derivatives[j][k].of];
    if (!factorize(schur, schur_scale, 1e-14))
      return false;
    solve_factorized(schur, schur_scale, multipliers);
    return true;
  }

  template <unsigned int degree>
  TETRADAPT_CLONES void
  PatchSolver<degree>::solve_inside()
  {
    InnerSystem system;
    double      multipliers[3 * n_lower];
    if (!invert_weights(system))
      return; // cells in a plane: the fit to the samples is all there is
    find_columns(system);
    if (!find_multipliers(system, multipliers))
      return;
    double change[6][n] = {};
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int r = 0; r < n_lower; ++r)
          for (unsigned int m = 0; m < n; ++m)
            change[stress_index[i][j]][m] += multipliers[n_lower * i + r] * system.columns[j][r][m];
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < 6; ++b)
        if (inverse_metric[a][b] != 0.)
          for (unsigned int m = 0; m < n; ++m)
            solution[a][m] -= inverse_metric[a][b] * change[b][m];
  }

  template <unsigned int degree>
  TETRADAPT_CLONES void
  PatchSolver<degree>::add_face(const Point<3> &center, const StressConditions::Face &face)
  {
    for (unsigned int q = 0; q < face.n_points; ++q)
      {
        double m[n];
        monomials<degree>(scale * (face.points[q][0] - center[0]),
                          scale * (face.points[q][1] - center[1]),
                          scale * (face.points[q][2] - center[2]),
                          m);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            products[i][j] += m[i] * m[j];
        for (unsigned int a = 0; a < 6; ++a)
          for (unsigned int i = 0; i < n; ++i)
            right[n * a + i] += face.right[q][a] * m[i];
      }
  }

  template <unsigned int degree>
  TETRADAPT_CLONES void
  PatchSolver<degree>::add_products(const double (&of_components)[6][6])
  {
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b <= a; ++b)
        if (of_components[a][b] != 0.)
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              matrix[n * a + i][n * b + j] += of_components[a][b] * products[i][j];
    std::fill(&products[0][0], &products[0][0] + n * n, 0.);
  }

  template <unsigned int degree>
  void
  PatchSolver<degree>::add_faces(const Point<3> &center, const std::vector<unsigned int> &cells)
  {
    // Faces in one plane and with the same conditions have the same matrix: what is common
    // to the components is summed up first.
    const StressConditions::Face *last = nullptr;
    std::fill(&products[0][0], &products[0][0] + n * n, 0.);
    for (const unsigned int cell : cells)
      for (unsigned int f = conditions->begin[cell]; f < conditions->begin[cell + 1]; ++f)
        {
          const StressConditions::Face &face = conditions->faces[f];
          if (last != nullptr
              && !std::equal(&face.matrix[0][0], &face.matrix[0][0] + 36, &last->matrix[0][0]))
            add_products(last->matrix);
          add_face(center, face);
          last = &face;
        }
    if (last != nullptr)
      add_products(last->matrix);
  }

  template <unsigned int degree>
  TETRADAPT_CLONES void
  PatchSolver<degree>::add_equilibrium()
  {
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          const unsigned int a = n * stress_index[i][j];
          for (unsigned int k = 0; k < n_derivatives[degree]; ++k)
            {
              const Derivative &first = derivatives[j][k];
              right[a + first.of] += first.factor * targets[i][first.to];
              for (unsigned int l = 0; l < 3; ++l)
                {
                  const unsigned int b = n * stress_index[i][l];
                  for (unsigned int h = 0; h < n_derivatives[degree]; ++h)
                    {
                      const Derivative &second = derivatives[l][h];
                      if (b + second.of <= a + first.of)
                        matrix[a + first.of][b + second.of]
                          += first.factor * second.factor * weights[first.to][second.to];
                    }
                }
            }
        }
  }

  template <unsigned int degree>
  TETRADAPT_CLONES bool
  PatchSolver<degree>::solve_at_boundary(const Point<3>                  &center,
                                         const std::vector<unsigned int> &cells)
  {
    std::fill(&matrix[0][0], &matrix[0][0] + n_all * n_all, 0.);
    std::fill(right, right + n_all, 0.);
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < 6; ++b)
        if (metric[a][b] != 0.)
          for (unsigned int i = 0; i < n; ++i)
            {
              right[n * a + i] += metric[a][b] * fit.right[b][i];
              if (b <= a)
                for (unsigned int j = 0; j < n; ++j)
                  matrix[n * a + i][n * b + j] = metric[a][b] * fit.moments[i][j];
            }
    add_faces(center, cells);
    add_equilibrium();
    if (!factorize(matrix, matrix_scale, 1e-3 * determined))
      return false;
    solve_factorized(matrix, matrix_scale, right);
    std::copy(right, right + n_all, &solution[0][0]);
    return true;
  }

  template <unsigned int degree>
  TETRADAPT_CLONES bool
  PatchSolver<degree>::solve(const unsigned int               vertex,
                             const std::vector<unsigned int> &cells,
                             double                          &unit,
                             double                          *coefficients)
  {
    if (degree > 0 && cells.size() * n_a_cell < 2 * n)
      return false;
    const Point<3> &center = mesh.points[vertex];
    collect(center, cells);
    for (unsigned int i = 0; i < n; ++i)
      std::copy(fit.moments[i], fit.moments[i] + n, factor[i]);
    if (!factorize(factor, factor_scale, determined))
      return false;
    bool done = false;
    if (degree > 0 && conditions != nullptr)
      {
        set_metric(materials[cells[0]]);
        collect_equilibrium(center, cells);
        done = conditions->on_boundary[vertex] != 0 && solve_at_boundary(center, cells);
      }
    if (!done)
      {
        for (unsigned int a = 0; a < 6; ++a)
          {
            std::copy(fit.right[a], fit.right[a] + n, solution[a]);
            solve_factorized(factor, factor_scale, solution[a]);
          }
        if (degree > 0 && conditions != nullptr)
          solve_inside();
      }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int a = 0; a < 6; ++a)
        coefficients[6 * i + a] = solution[a][i];
    unit = length;
    return true;
  }

  template class PatchSolver<0>;
  template class PatchSolver<1>;
  template class PatchSolver<2>;
} // namespace tetradapt::compare
