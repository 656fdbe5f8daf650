// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_affine_form_h
#define tetradapt_core_affine_form_h

#include <deal.II/base/tensor.h>

#include <optional>
#include <string>

namespace tetradapt::core
{
  /** gradient . (x, y, z) + constant. */
  struct AffineForm
  {
    dealii::Tensor<1, 3> gradient;
    double               constant = 0.;
  };

  /**
   * The affine function of x, y, z that @p text is, if its structure says so: sums,
   * products with and quotients by constants, powers and functions of constants.
   * Nothing if it is not, or depends on t. @p text must be an expression that
   * core::Expression reads.
   */
  std::optional<AffineForm>
  affine_form(const std::string &text);
} // namespace tetradapt::core

#endif
