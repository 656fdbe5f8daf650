// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_exact_solution_h
#define tetradapt_compare_exact_solution_h

#include "tetradapt/core/expression.h"
#include "tetradapt/scene/model_parameters.h"

#include <optional>
#include <vector>

namespace tetradapt::compare
{
  using dealii::Point;
  using dealii::Tensor;

  /** A displacement given by expressions, and its gradient. */
  class ExactSolution
  {
  public:
    /** @throws InputError if an expression does not parse or if there is none. */
    explicit ExactSolution(const scene::ExactSolutionParameters &exact_solution);

    Tensor<1, 3>
    value(const Point<3> &point) const
    {
      return displacement(point);
    }

    /**
     * du_i/dx_j: from the expressions of the gradient, else by central
     * differences of order six,
     * f' = [45 (f_1 - f_-1) - 9 (f_2 - f_-2) + (f_3 - f_-3)] / (60 h) + O(h^6).
     * @param step their step h; not used if the gradient is given.
     */
    Tensor<2, 3>
    gradient(const Point<3> &point, double step) const;

  private:
    core::VectorExpression        displacement;
    std::vector<core::Expression> gradients; ///< nine, or none
  };
} // namespace tetradapt::compare

#endif
