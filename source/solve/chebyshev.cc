// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/chebyshev.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tetradapt::solve
{
  namespace
  {
    /** A number between -1 and 1 that looks random (Steele, Lea and Flood's SplitMix). */
    double
    pseudo_random(std::uint64_t i)
    {
      i = (i + 1) * 0x9e3779b97f4a7c15ULL;
      i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9ULL;
      i = (i ^ (i >> 27)) * 0x94d049bb133111ebULL;
      return static_cast<std::int64_t>(i ^ (i >> 31)) * 0x1p-63;
    }

    /** Largest eigenvalue of a symmetric tridiagonal matrix, by bisection. */
    double
    largest_of_tridiagonal(const std::vector<double> &diagonal,
                           const std::vector<double> &off_diagonal)
    {
      const std::size_t n     = diagonal.size();
      double            lower = diagonal[0], upper = diagonal[0];
      for (std::size_t i = 0; i < n; ++i)
        upper = std::max(upper,
                         diagonal[i] + (i > 0 ? std::abs(off_diagonal[i - 1]) : 0.)
                           + (i + 1 < n ? std::abs(off_diagonal[i]) : 0.));
      for (unsigned int step = 0; step < 30; ++step)
        {
          const double middle = 0.5 * (lower + upper);
          // Are all pivots of T - middle negative?
          double pivot = diagonal[0] - middle;
          bool   above = pivot < 0.;
          for (std::size_t i = 1; i < n && above; ++i)
            {
              pivot = diagonal[i] - middle - off_diagonal[i - 1] * off_diagonal[i - 1] / pivot;
              above = pivot < 0.;
            }
          (above ? upper : lower) = middle;
        }
      return upper;
    }
  } // namespace

  template <typename Number, unsigned int n>
  ChebyshevSmoother<Number, n>::ChebyshevSmoother(const mechanics::LinearOperator<Number> &matrix,
                                                  const std::vector<Block>                &inverses,
                                                  unsigned int                             degree,
                                                  const ClusterJacobi<Number>             *clusters)
    : matrix(matrix), inverses(clusters != nullptr ? clusters->without_own(inverses) : inverses),
      clusters(clusters), degree(degree)
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
    VectorOf<Number>  &r = residual, &z = direction, &Ap = product, p(r), copy(r);
    const unsigned int size  = n * inverses.n_nodes();
    const auto         first = matrix.vector_layout()->local_range().first;
    for (unsigned int i = 0; i < size; ++i)
      r.local_element(i) = pseudo_random(first + i);
    std::vector<double> diagonal, off_diagonal;
    double              rz = 0., alpha = 0.;
    for (unsigned int step = 0; step < 10; ++step)
      {
        inverses.start(1., r.begin(), copy.begin(), z.begin());
        if (clusters != nullptr)
          clusters->add(1., r.begin(), copy.begin(), z.begin());
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
          off_diagonal.push_back(std::sqrt(beta) / last);
        r.add(static_cast<Number>(-alpha), Ap);
      }
    return diagonal.empty() ? 1. : 1.1 * largest_of_tridiagonal(diagonal, off_diagonal);
  }

  template <typename Number, unsigned int n>
  void
  ChebyshevSmoother<Number, n>::start(VectorOf<Number> &x, const VectorOf<Number> &b) const
  {
    inverses.start(4. / (3. * lambda), b.begin(), direction.begin(), x.begin());
    if (clusters != nullptr)
      clusters->add(4. / (3. * lambda), b.begin(), direction.begin(), x.begin());
    iterate(x, b, 2);
  }

  template <typename Number, unsigned int n>
  void
  ChebyshevSmoother<Number, n>::step(VectorOf<Number> &x, const VectorOf<Number> &b) const
  {
    matrix.vmult(product, x);
    step_of_all({0., 4. / (3. * lambda), degree == 1}, b.begin(), x);
    iterate(x, residual, 2);
  }

  template <typename Number, unsigned int n>
  void
  ChebyshevSmoother<Number, n>::step_of_all(JacobiStep        step,
                                            const Number     *from,
                                            VectorOf<Number> &x) const
  {
    if (clusters != nullptr)
      step.is_last = false; // the clusters need the residual also
    inverses.step(step, from, product.begin(), residual.begin(), direction.begin(), x.begin());
    if (clusters != nullptr)
      clusters->add(step.factor, residual.begin(), direction.begin(), x.begin());
  }

  template <typename Number, unsigned int n>
  void
  ChebyshevSmoother<Number, n>::iterate(VectorOf<Number>       &x,
                                        const VectorOf<Number> &first,
                                        unsigned int            begin) const
  {
    for (unsigned int k = begin; k <= degree; ++k)
      {
        matrix.vmult(product, direction);
        step_of_all({(2. * k - 3.) / (2. * k + 1.),
                     (8. * k - 4.) / ((2. * k + 1.) * lambda),
                     k == degree},
                    k == begin ? first.begin() : residual.begin(),
                    x);
      }
  }

  template class ChebyshevSmoother<double, 3>;
  template class ChebyshevSmoother<double, 6>;
  template class ChebyshevSmoother<float, 3>;
  template class ChebyshevSmoother<float, 6>;
} // namespace tetradapt::solve
