// SPDX-License-Identifier: AGPL-3.0-or-later
#include "difference.h"

#include "tetradapt/core/clones.h"

#include <cmath>
#include <stdexcept>

namespace tetradapt::estimate
{
  namespace
  {
    using core::Lanes;
    constexpr unsigned int n_vectors = RecoveryDifference::n_vectors;

    /** Adds corner @p i's barycentric coordinates times its patch's polynomial. */
    template <unsigned int degree>
    TETRADAPT_INLINE void
    add_polynomial(const RecoveryDifference::Cell &cell,
                   const RecoveryDifference::Rule &rule,
                   const unsigned int              i,
                   Lanes (&difference)[6][n_vectors])
    {
      constexpr unsigned int n          = n_monomials[degree];
      const double          *polynomial = cell.polynomials[i];
      const double           scale      = 1. / polynomial[0];
      double                 edges[4][3]; // from the patch's vertex, in its unit of length
      for (unsigned int j = 0; j < 4; ++j)
        for (unsigned int d = 0; d < 3; ++d)
          edges[j][d] = scale * (cell.corners[j][d] - cell.corners[i][d]);
      alignas(64) Lanes m[n_vectors][n];
      for (unsigned int v = 0; v < n_vectors; ++v)
        {
          Lanes x[3];
          for (unsigned int d = 0; d < 3; ++d)
            x[d] = rule.barycentric[0][v] * edges[0][d] + rule.barycentric[1][v] * edges[1][d]
                   + rule.barycentric[2][v] * edges[2][d] + rule.barycentric[3][v] * edges[3][d];
          monomials<degree>(x[0], x[1], x[2], m[v]);
        }
      for (unsigned int c = 0; c < 6; ++c)
        for (unsigned int v = 0; v < n_vectors; ++v)
          {
            Lanes sum = m[v][0] * polynomial[1 + c];
            for (unsigned int k = 1; k < n; ++k)
              sum += polynomial[1 + 6 * k + c] * m[v][k];
            difference[c][v] += rule.barycentric[i][v] * sum;
          }
    }

    template <unsigned int degree>
    TETRADAPT_INLINE double
    mean_density_of(const RecoveryDifference::Cell &cell, const RecoveryDifference::Rule &rule)
    {
      alignas(64) Lanes difference[6][n_vectors];
      for (unsigned int c = 0; c < 6; ++c)
        for (unsigned int v = 0; v < n_vectors; ++v)
          difference[c][v] = -(rule.barycentric[0][v] * cell.stress[0][c]
                               + rule.barycentric[1][v] * cell.stress[1][c]
                               + rule.barycentric[2][v] * cell.stress[2][c]
                               + rule.barycentric[3][v] * cell.stress[3][c]);
      for (unsigned int i = 0; i < 4; ++i)
        add_polynomial<degree>(cell, rule, i, difference);
      double sum = 0.;
      for (unsigned int v = 0; v < n_vectors; ++v)
        {
          Lanes density = {};
          for (unsigned int a = 0; a < 6; ++a)
            {
              Lanes strain = {};
              for (unsigned int b = 0; b < 6; ++b)
                strain += cell.compliance[6 * a + b] * difference[b][v];
              density += strain * difference[a][v];
            }
          density *= rule.weights[v];
          for (unsigned int l = 0; l < core::n_lanes; ++l)
            sum += density[l];
        }
      return sum;
    }

    // One a degree: a template would not be compiled for several processors.

    TETRADAPT_CLONES double
    mean_density_linear(const RecoveryDifference::Cell &cell, const RecoveryDifference::Rule &rule)
    {
      return mean_density_of<1>(cell, rule);
    }

    TETRADAPT_CLONES double
    mean_density_quadratic(const RecoveryDifference::Cell &cell,
                           const RecoveryDifference::Rule &rule)
    {
      return mean_density_of<2>(cell, rule);
    }
  } // namespace

  RecoveryDifference::RecoveryDifference(const mesh::TetMesh          &mesh,
                                         const CellStress             &stress,
                                         const RecoveredStress        &recovered,
                                         const compare::TetQuadrature &rule)
    : mesh(mesh), stress(stress), recovered(recovered), linear(recovered.degree() == 1)
  {
    if (rule.points.size() > n_vectors * core::n_lanes)
      throw std::invalid_argument("RecoveryDifference: a rule of more than 16 points");
    for (unsigned int q = 0; q < n_vectors * core::n_lanes; ++q)
      {
        const bool         used = q < rule.points.size();
        const unsigned int v = q / core::n_lanes, l = q % core::n_lanes;
        for (unsigned int i = 0; i < 4; ++i)
          lanes.barycentric[i][v][l] = rule.points[used ? q : 0][i];
        lanes.weights[v][l] = used ? rule.weights[q] : 0.;
      }
  }

  double
  RecoveryDifference::operator()(const unsigned int cell) const
  {
    Cell          numbers;
    const double *values = stress.elastic(cell);
    for (unsigned int i = 0; i < 4; ++i)
      {
        const Point<3> &corner = mesh.points[mesh.cells[cell][i]];
        for (unsigned int d = 0; d < 3; ++d)
          numbers.corners[i][d] = corner[d];
        // One stress in a cell for degree 1, four for degree 2.
        std::copy_n(values + (linear ? 0 : 6 * i), 6, numbers.stress[i]);
        numbers.polynomials[i] = recovered.polynomial(recovered.patches_of_cell(cell)[i]);
      }
    numbers.compliance = &stress.materials()[cell].compliance[0][0];
    const double mean
      = linear ? mean_density_linear(numbers, lanes) : mean_density_quadratic(numbers, lanes);
    return std::sqrt(std::max(mean, 0.) * mesh::cell_volume(mesh, cell));
  }
} // namespace tetradapt::estimate
