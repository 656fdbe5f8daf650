// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/chebyshev.h"

#include "tetradapt/solve/conjugate_gradients.h"

#include <deal.II/lac/tridiagonal_matrix.h>

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

    /** Ends conjugate gradients after some steps, and collects the tridiagonal matrix of Lanczos
     * that their coefficients make (Golub and Van Loan, Matrix Computations, section 10.2). */
    class LanczosControl : public GainControl
    {
    public:
      /** The largest eigenvalue of that matrix; 1 if there is none. */
      double
      largest_eigenvalue() const
      {
        if (diagonal.empty())
          return 1.;
        dealii::TridiagonalMatrix<double> matrix(diagonal.size(), true);
        for (unsigned int i = 0; i < diagonal.size(); ++i)
          {
            matrix(i, i) = diagonal[i];
            if (i > 0)
              matrix(i - 1, i) = off_diagonal[i - 1];
          }
        matrix.compute_eigenvalues();
        return matrix.eigenvalue(diagonal.size() - 1);
      }

    protected:
      State
      decide(const unsigned int step, const double residual, const double gain) override
      {
        if (step > 0)
          {
            const double energy = preconditioned_square();
            if (!(energy > 0.))
              return State::success; // nothing is left
            const double alpha = gain / energy, beta = step == 1 ? 0. : energy / last_energy;
            diagonal.push_back(1. / alpha + (step == 1 ? 0. : beta / last_alpha));
            if (step > 1)
              off_diagonal.push_back(std::sqrt(beta) / last_alpha);
            last_alpha  = alpha;
            last_energy = energy;
          }
        return step == n_steps || residual == 0. ? State::success : State::iterate;
      }

    private:
      static constexpr unsigned int n_steps = 10;
      std::vector<double>           diagonal, off_diagonal;
      double                        last_alpha = 0., last_energy = 0.;
    };

    /** The inverses of the diagonal's blocks as a preconditioner. */
    template <typename Number, unsigned int n>
    struct Jacobi
    {
      const BlockJacobi<Number, n> &inverses;
      const ClusterJacobi<Number>  *clusters; ///< may be null
      VectorOf<Number>             &work;

      void
      vmult(VectorOf<Number> &z, const VectorOf<Number> &r) const
      {
        inverses.start(1., r.begin(), work.begin(), z.begin());
        if (clusters != nullptr)
          clusters->add(1., r.begin(), work.begin(), z.begin());
      }
    };
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
    // For a right-hand side that has something of every eigenvector.
    VectorOf<Number>   b(residual), x(residual);
    const unsigned int size  = n * inverses.n_nodes();
    const auto         first = matrix.vector_layout()->local_range().first;
    for (unsigned int i = 0; i < size; ++i)
      b.local_element(i) = pseudo_random(first + i);
    LanczosControl control;
    conjugate_gradients(matrix, Jacobi<Number, n>{inverses, clusters, direction}, b, control, x);
    return 1.1 * control.largest_eigenvalue();
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
