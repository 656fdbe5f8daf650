// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_expression_h
#define tetradapt_core_expression_h

#include <deal.II/base/point.h>

#include <array>
#include <memory>
#include <string>

namespace tetradapt::core
{
  using dealii::Point;
  using dealii::Tensor;

  /**
   * A scalar function of x, y, z and t, given as text and evaluated by muParser; that of a
   * load on a surface may also use nx, ny, nz, the unit normal that points out of the body.
   *
   * Known in addition to muParser's own functions: the constants `pi` (also `_pi`) and
   * `e` (also `_e`), `if(condition, a, b)`, and the operators `&&`, `||`, `!`.
   * Objects may be copied; each copy owns its parser, so two copies may be used
   * by two threads, one object by one thread at a time.
   */
  class Expression
  {
  public:
    /** The variables that a text may use. */
    enum class Variables
    {
      point,            ///< x, y, z, t
      point_and_normal, ///< also nx, ny, nz
    };

    /**
     * Compiles @p text.
     * @param what names the place in messages, for example
     *        "Loads/tip/Value, component y".
     * @throws InputError if the text is empty, does not parse or uses an
     *         unknown name; the message quotes the text and marks the position.
     */
    Expression(const std::string &text,
               const std::string &what,
               Variables          variables = Variables::point);
    Expression(const Expression &other);
    Expression(Expression &&other) noexcept;
    Expression &
    operator=(const Expression &other);
    Expression &
    operator=(Expression &&other) noexcept;
    ~Expression();

    /**
     * The value at @p point and time @p t.
     * @throws InputError naming the expression and the point if the value is
     *         not finite.
     */
    double
    operator()(const Point<3> &point, double t = 0.) const;

    /** The same on a surface with normal @p normal. */
    double
    operator()(const Point<3> &point, const Tensor<1, 3> &normal) const;

    /** Whether the text names one of nx, ny, nz. */
    bool
    uses_normal() const;

    /** As operator(), but true for any value other than zero. */
    bool
    holds(const Point<3> &point, double t = 0.) const;

    /** Whether the text names no variable. */
    bool
    is_constant() const;

    const std::string &
    text() const;

  private:
    double
    evaluate(const Point<3> &point) const;

    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };

  /** Three expressions, one a component. */
  class VectorExpression
  {
  public:
    /** @throws InputError as Expression does; @p what names the place. */
    VectorExpression(const std::array<std::string, 3> &texts,
                     const std::string                &what,
                     Expression::Variables             variables = Expression::Variables::point);

    Tensor<1, 3>
    operator()(const Point<3> &point, double t = 0.) const;

    Tensor<1, 3>
    operator()(const Point<3> &point, const Tensor<1, 3> &normal) const;

    bool
    is_constant() const;

    bool
    uses_normal() const;

  private:
    std::array<Expression, 3> components;
  };
} // namespace tetradapt::core

#endif
