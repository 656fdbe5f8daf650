// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/chebyshev.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::solve
{
  namespace
  {
    /** Inverts in place by Gauss and Jordan's method without pivots, which positive blocks
     * do not need; false if a pivot is not positive beside the diagonal. */
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

    /** Largest eigenvalue of a symmetric tridiagonal matrix, by bisection. */
    double
    largest_of_tridiagonal(const std::vector<double> &diagonal, const std::vector<double> &beside)
    {
      const std::size_t n     = diagonal.size();
      double            lower = diagonal[0], upper = diagonal[0];
      for (std::size_t i = 0; i < n; ++i)
        upper = std::max(upper,
                         diagonal[i] + (i > 0 ? std::abs(beside[i - 1]) : 0.)
                           + (i + 1 < n ? std::abs(beside[i]) : 0.));
      for (unsigned int step = 0; step < 30; ++step)
        {
          const double middle = 0.5 * (lower + upper);
          // Are all pivots of T - middle negative?
          double pivot = diagonal[0] - middle;
          bool   above = pivot < 0.;
          for (std::size_t i = 1; i < n && above; ++i)
            {
              pivot = diagonal[i] - middle - beside[i - 1] * beside[i - 1] / pivot;
              above = pivot < 0.;
            }
          (above ? upper : lower) = middle;
        }
      return upper;
    }

    /** y += factor * D^-1 x for the nodes of this rank, after y *= keep. */
    template <typename Number, unsigned int n>
    void
    add_scaled(const std::vector<std::array<Number, n * n>> &inverses,
               Number                                        keep,
               Number                                        factor,
               const Number *__restrict x,
               Number *__restrict y)
    {
      for (std::size_t node = 0; node < inverses.size(); ++node, x += n, y += n)
        {
          const auto &m = inverses[node];
          Number      z[n];
          for (unsigned int i = 0; i < n; ++i)
            {
              z[i] = 0;
              for (unsigned int j = 0; j < n; ++j)
                z[i] += m[i * n + j] * x[j];
            }
          for (unsigned int i = 0; i < n; ++i)
            y[i] = keep * y[i] + factor * z[i];
        }
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
  ChebyshevSmoother<Number, n>::ChebyshevSmoother(const mechanics::LinearOperator<Number> &matrix,
                                                  std::vector<Block>                       inverses,
                                                  unsigned int                             degree)
    : matrix(matrix), inverses(std::move(inverses)), degree(degree)
  {
    for (auto *vector : {&residual, &direction, &product})
      vector->reinit(matrix.vector_layout());
    lambda = estimate_lambda();
  }

  template <typename Number, unsigned int n>
  double
  ChebyshevSmoother<Number, n>::estimate_lambda() const
  {
    // Conjugate gradients for a right-hand side that has something of every eigenvector;
    // their coefficients are those of Lanczos' tridiagonal matrix.
    VectorOf<Number>  &r = residual, &z = direction, &Ap = product, p(r);
    const unsigned int size  = n * inverses.size();
    const auto         first = matrix.vector_layout()->local_range().first;
    for (unsigned int i = 0; i < size; ++i)
      r.local_element(i) = std::sin(1. + 1.7 * (first + i)) + std::cos(0.3 * (first + i));
    std::vector<double> diagonal, beside;
    double              rz = 0., alpha = 0.;
    for (unsigned int step = 0; step < 10; ++step)
      {
        add_scaled<Number, n>(inverses, 0, 1, r.begin(), z.begin());
        const double before = rz;
        rz                  = r * z;
        if (!(rz > 0.))
          break;
        const double beta = step == 0 ? 0. : rz / before;
        p.sadd(static_cast<Number>(beta), 1, z);
        matrix.vmult(Ap, p);
        const double pAp = p * Ap;
        if (!(pAp > 0.))
          break;
        const double last = alpha;
        alpha             = rz / pAp;
        diagonal.push_back(1. / alpha + (step == 0 ? 0. : beta / last));
        if (step > 0)
          beside.push_back(std::sqrt(beta) / last);
        r.add(static_cast<Number>(-alpha), Ap);
      }
    return diagonal.empty() ? 1. : 1.1 * largest_of_tridiagonal(diagonal, beside);
  }

  template <typename Number, unsigned int n>
  void
  ChebyshevSmoother<Number, n>::start(VectorOf<Number> &x, const VectorOf<Number> &b) const
  {
    add_scaled<Number, n>(inverses, 0, 4. / (3. * lambda), b.begin(), direction.begin());
    std::copy(direction.begin(), direction.end(), x.begin());
    if (degree > 1)
      {
        std::copy(b.begin(), b.end(), residual.begin());
        iterate(x, 2);
      }
  }

  template <typename Number, unsigned int n>
  void
  ChebyshevSmoother<Number, n>::step(VectorOf<Number> &x, const VectorOf<Number> &b) const
  {
    matrix.vmult(product, x);
    const unsigned int size = n * inverses.size();
    for (unsigned int i = 0; i < size; ++i)
      residual.local_element(i) = b.local_element(i) - product.local_element(i);
    add_scaled<Number, n>(inverses, 0, 4. / (3. * lambda), residual.begin(), direction.begin());
    x += direction;
    iterate(x, 2);
  }

  template <typename Number, unsigned int n>
  void
  ChebyshevSmoother<Number, n>::iterate(VectorOf<Number> &x, unsigned int begin) const
  {
    for (unsigned int k = begin; k <= degree; ++k)
      {
        matrix.vmult(product, direction);
        residual -= product;
        add_scaled<Number, n>(inverses,
                              (2. * k - 3.) / (2. * k + 1.),
                              (8. * k - 4.) / ((2. * k + 1.) * lambda),
                              residual.begin(),
                              direction.begin());
        x += direction;
      }
  }

  template std::vector<std::array<double, 9>>
  invert_blocks<double, 3>(const std::vector<std::array<double, 9>> &);
  template std::vector<std::array<double, 36>>
  invert_blocks<double, 6>(const std::vector<std::array<double, 36>> &);
  template std::vector<std::array<float, 9>>
  invert_blocks<float, 3>(const std::vector<std::array<float, 9>> &);
  template std::vector<std::array<float, 36>>
  invert_blocks<float, 6>(const std::vector<std::array<float, 36>> &);
  template class ChebyshevSmoother<double, 3>;
  template class ChebyshevSmoother<double, 6>;
  template class ChebyshevSmoother<float, 3>;
  template class ChebyshevSmoother<float, 6>;
} // namespace tetradapt::solve
