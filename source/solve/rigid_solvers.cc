// SPDX-License-Identifier: AGPL-3.0-or-later
#include "rigid_solvers.h"

#include "tetradapt/core/exceptions.h"

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::solve
{
  namespace
  {
    /** Of a diagonal entry of S, that is left when the others are eliminated. */
    constexpr double smallest_pivot = 1e-12;

    /** The matrix with supports that fix the coupled nodes. */
    mechanics::BlockMatrix
    with_fixed(mechanics::BlockMatrix           matrix,
               const mechanics::RigidCouplings &couplings,
               const fem::Space                &space)
    {
      std::vector<unsigned char> is_coupled(space.n_local_nodes(), 0);
      for (const auto &node : couplings.nodes())
        is_coupled[node.local] = 1;
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        for (std::size_t k = matrix.row_begin(row); k < matrix.row_end(row); ++k)
          if (is_coupled[row] != 0 || is_coupled[matrix.column(k)] != 0)
            for (unsigned int i = 0; i < 9; ++i)
              if (matrix.column(k) != row || i % 4 != 0)
                matrix.block(k)[i] = 0.;
      return matrix;
    }

    /** Whether a symmetric matrix is positive definite beyond rounding. */
    bool
    is_positive(dealii::FullMatrix<double> matrix)
    {
      const unsigned int  n = matrix.m();
      std::vector<double> diagonal(n);
      for (unsigned int i = 0; i < n; ++i)
        diagonal[i] = matrix(i, i);
      for (unsigned int p = 0; p < n; ++p)
        {
          if (!(matrix(p, p) > smallest_pivot * diagonal[p]))
            return false;
          for (unsigned int i = p + 1; i < n; ++i)
            for (unsigned int j = p + 1; j < n; ++j)
              matrix(i, j) -= matrix(i, p) * matrix(p, j) / matrix(p, p);
        }
      return true;
    }
  } // namespace

  std::vector<mechanics::RigidCoupling>
  restrict_to_vertices(const std::vector<mechanics::RigidCoupling> &couplings,
                       const unsigned int                           n_points)
  {
    auto result = couplings;
    for (auto &coupling : result)
      {
        const std::size_t n_vertices
          = std::lower_bound(coupling.nodes.begin(), coupling.nodes.end(), n_points)
            - coupling.nodes.begin();
        coupling.nodes.resize(n_vertices);
        coupling.positions.resize(n_vertices);
        coupling.make_basis();
      }
    return result;
  }

  RigidDirectSolver::RigidDirectSolver(const mechanics::BlockMatrix    &matrix,
                                       const fem::Space                &space,
                                       const mechanics::RigidCouplings &couplings)
    : couplings(couplings),
      fixed(std::make_unique<DirectSolver>(with_fixed(matrix, couplings, space), space))
  {
    const unsigned int  n = couplings.n_free_motions();
    std::vector<Vector> products(n);
    Vector              force(matrix.vector_layout());
    for (unsigned int k = 0; k < n; ++k)
      {
        motions.emplace_back(matrix.vector_layout());
        products[k].reinit(matrix.vector_layout());
        Vector &w = motions.back();
        couplings.add_column(k, w);
        matrix.vmult(force, w);
        couplings.clear(force);
        Vector others(force);
        fixed->solve(force, others);
        w -= others;
        matrix.vmult(products[k], w);
      }
    dealii::FullMatrix<double> S(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        S(i, j) = S(j, i) = motions[i] * products[j];
    if (!is_positive(S))
      throw core::NumericalError(
        "The direct solver could not solve for the motions of the supports of type rigid: the "
        "matrix is singular to rounding. Either a part of the body is free to move, or materials "
        "have very different stiffness. Add a support.");
    S.gauss_jordan();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        inverse.push_back(0.5 * (S(i, j) + S(j, i)));
  }

  void
  RigidDirectSolver::solve(const Vector &right_hand_side, Vector &solution) const
  {
    const unsigned int  n = motions.size();
    std::vector<double> products(n);
    for (unsigned int k = 0; k < n; ++k)
      products[k] = motions[k] * right_hand_side;
    Vector others(right_hand_side);
    couplings.clear(others);
    fixed->solve(others, solution);
    for (unsigned int i = 0; i < n; ++i)
      {
        double factor = 0.;
        for (unsigned int j = 0; j < n; ++j)
          factor += inverse[i * n + j] * products[j];
        solution.add(factor, motions[i]);
      }
    couplings.project(solution);
  }
} // namespace tetradapt::solve
