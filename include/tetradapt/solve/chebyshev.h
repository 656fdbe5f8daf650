// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_chebyshev_h
#define tetradapt_solve_chebyshev_h

#include "tetradapt/mechanics/linear_operator.h"
#include "tetradapt/solve/block_jacobi.h"
#include "tetradapt/solve/cluster_jacobi.h"

namespace tetradapt::solve
{
  template <typename Number>
  using VectorOf = mechanics::VectorOf<Number>;

  /**
   * A smoother of multigrid: Chebyshev polynomials of the fourth kind in D^-1 A, with D the
   * diagonal blocks of A (J. Lottes, Optimal polynomial smoothers for multigrid V-cycles,
   * Numer. Linear Algebra Appl. 30, 2023). They need the largest eigenvalue only, which
   * some steps of Lanczos' method estimate.
   *
   * @tparam n is the size of the blocks: the unknowns of a node.
   */
  template <typename Number, unsigned int n>
  class ChebyshevSmoother
  {
  public:
    using Block = std::array<Number, n * n>;

    /** Collective. Keeps references to @p matrix and to @p clusters.
     * @param inverses as invert_blocks() makes them; zero rows keep an unknown at zero.
     * @param clusters if not null, are larger diagonal blocks, which D has in place of the
     *        @p inverses of their nodes. */
    ChebyshevSmoother(const mechanics::LinearOperator<Number> &matrix,
                      const std::vector<Block>                &inverses,
                      unsigned int                             degree,
                      const ClusterJacobi<Number>             *clusters = nullptr);

    /** One sweep from x = 0. degree - 1 products with the matrix. Collective. */
    void
    start(VectorOf<Number> &x, const VectorOf<Number> &b) const;

    /** One sweep from @p x on. degree products. Collective. */
    void
    step(VectorOf<Number> &x, const VectorOf<Number> &b) const;

    /** The degree of the polynomials from now on. */
    void
    set_degree(const unsigned int new_degree)
    {
      degree = new_degree;
    }

    /** The estimate of the largest eigenvalue of D^-1 A, with its margin. */
    double
    largest_eigenvalue() const
    {
      return lambda;
    }

  private:
    double
    estimate_lambda() const;
    /** BlockJacobi's step, and then that of the clusters. */
    void
    step_of_all(JacobiStep step, const Number *from, VectorOf<Number> &x) const;
    /** The steps from @p begin on; @p first is the residual before the last one. */
    void
    iterate(VectorOf<Number> &x, const VectorOf<Number> &first, unsigned int begin) const;

    const mechanics::LinearOperator<Number> &matrix;
    BlockJacobi<Number, n>                   inverses;
    const ClusterJacobi<Number>             *clusters;
    unsigned int                             degree;
    double                                   lambda = 0.;
    mutable VectorOf<Number>                 residual, direction, product;
  };
} // namespace tetradapt::solve

#endif
