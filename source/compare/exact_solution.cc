// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/exact_solution.h"

#include "tetradapt/core/exceptions.h"

namespace tetradapt::compare
{
  namespace
  {
    const scene::ExactSolutionParameters &
    with_displacement(const scene::ExactSolutionParameters &exact_solution)
    {
      if (!exact_solution.has_displacement())
        throw core::InputError("An exact displacement is needed here, but the scene gives none: "
                               "give its three components as expressions in x, y, z.");
      return exact_solution;
    }
  } // namespace

  ExactSolution::ExactSolution(const scene::ExactSolutionParameters &exact_solution)
    : displacement(with_displacement(exact_solution).displacement, "the exact displacement")
  {
    if (exact_solution.has_gradient())
      for (unsigned int i = 0; i < 9; ++i)
        gradients.emplace_back(exact_solution.gradient[i],
                               std::string("the exact displacement's gradient, du_") + "xyz"[i / 3]
                                 + "/d" + "xyz"[i % 3]);
  }

  Tensor<2, 3>
  ExactSolution::gradient(const Point<3> &point, const double step) const
  {
    Tensor<2, 3> result;
    if (!gradients.empty())
      {
        for (unsigned int i = 0; i < 9; ++i)
          result[i / 3][i % 3] = gradients[i](point);
        return result;
      }
    constexpr double weights[3] = {45. / 60., -9. / 60., 1. / 60.};
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int k = 1; k <= 3; ++k)
        {
          Point<3> ahead = point, behind = point;
          ahead[j] += k * step;
          behind[j] -= k * step;
          // The distance after rounding, not the one wanted: far from the origin
          // they differ.
          const double       distance = ahead[j] - behind[j];
          const Tensor<1, 3> change   = displacement(ahead) - displacement(behind);
          for (unsigned int i = 0; i < 3; ++i)
            result[i][j] += weights[k - 1] * 2. * k * change[i] / distance;
        }
    return result;
  }
} // namespace tetradapt::compare
