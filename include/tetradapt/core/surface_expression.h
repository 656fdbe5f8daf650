// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_surface_expression_h
#define tetradapt_core_surface_expression_h

#include "tetradapt/core/expression.h"

namespace tetradapt::core
{
  /**
   * A vector function of a point of a surface: three texts as Expression reads them, in which nx,
   * ny, nz are also known, the unit normal that points out of the body. Not to be copied.
   */
  class SurfaceExpression
  {
  public:
    /** @throws InputError as Expression does; @p what names the place. */
    SurfaceExpression(const std::array<std::string, 3> &texts, const std::string &what);
    SurfaceExpression(SurfaceExpression &&) noexcept;
    ~SurfaceExpression();

    /** Looks at one text alone. @throws InputError if it does not parse, or is constant but
     * not finite. */
    static void
    check(const std::string &text, const std::string &what);

    /** @throws InputError naming the expression and the point if a value is not finite. */
    Tensor<1, 3>
    operator()(const Point<3> &point, const Tensor<1, 3> &normal) const;

    /** Whether the texts name no variable. */
    bool
    is_constant() const;

    /** Whether they name one of nx, ny, nz. */
    bool
    uses_normal() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace tetradapt::core

#endif
