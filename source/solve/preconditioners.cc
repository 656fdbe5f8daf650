// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/preconditioners.h"

namespace tetradapt::solve
{
  namespace
  {
    class InDouble : public Preconditioner
    {
    public:
      InDouble(std::unique_ptr<ApproximateInverse<float>>                        inverse,
               double                                                            scale,
               const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout)
        : inverse(std::move(inverse)), scale(scale), input(layout), output(layout)
      {
      }

      void
      vmult(Vector &destination, const Vector &source) const override
      {
        // Any power of ten would leave the range of single precision in some model.
        const double largest = source.linfty_norm();
        if (!(largest > 0.))
          {
            destination = source;
            return;
          }
        const std::size_t   n    = source.locally_owned_size();
        const double *const from = source.begin();
        double *const       to   = destination.begin();
        for (std::size_t i = 0; i < n; ++i)
          input.local_element(i) = static_cast<float>(from[i] / largest);
        inverse->vmult(output, input);
        const double factor = scale * largest;
        for (std::size_t i = 0; i < n; ++i)
          to[i] = factor * output.local_element(i);
      }

      void
      set_smoother_degree(const unsigned int degree) override
      {
        inverse->set_smoother_degree(degree);
      }

    private:
      std::unique_ptr<ApproximateInverse<float>> inverse;
      double                                     scale;
      mutable VectorOf<float>                    input, output;
    };
  } // namespace

  std::unique_ptr<Preconditioner>
  in_double(std::unique_ptr<ApproximateInverse<float>>                        inverse,
            double                                                            scale,
            const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout)
  {
    return std::make_unique<InDouble>(std::move(inverse), scale, layout);
  }
} // namespace tetradapt::solve
