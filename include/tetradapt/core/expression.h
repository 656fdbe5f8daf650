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
   * A scalar function of x, y, z and t, given as text and evaluated by muParser.
   *
   * Known in addition to muParser's own functions: the constants `pi` (also `_pi`) and
   * `e` (also `_e`), `if(condition, a, b)`, and the operators `&&`, `||`, `!`.
   * Objects may be copied; each copy owns its parser, so two copies may be used
   * by two threads, one object by one thread at a time.
   */
  class Expression
  {
  public:
    /**
     * Compiles @p text.
     * @param what names the place in messages, for example
     *        "Loads/tip/Value, component y".
     * @throws InputError if the text is empty, does not parse or uses an
     *         unknown name; the message quotes the text and marks the position.
     */
    Expression(const std::string &text, const std::string &what);
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

    /** As operator(), but true for any value other than zero. */
    bool
    holds(const Point<3> &point, double t = 0.) const;

    /** Whether the text names none of x, y, z, t. */
    bool
    is_constant() const;

    const std::string &
    text() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };

  /** Three expressions, one a component. */
  class VectorExpression
  {
  public:
    /** @throws InputError as Expression does; @p what names the place. */
    VectorExpression(const std::array<std::string, 3> &texts, const std::string &what);

    Tensor<1, 3>
    operator()(const Point<3> &point, double t = 0.) const;

    bool
    is_constant() const;

  private:
    std::array<Expression, 3> components;
  };
} // namespace tetradapt::core

#endif
