// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_polynomial_fit_h
#define tetradapt_compare_polynomial_fit_h

#include <deal.II/base/point.h>

namespace tetradapt::compare
{
  using dealii::Point;

  /** Numbers of monomials in three variables up to degree 0, 1 and 2. */
  constexpr unsigned int n_monomials[3] = {1, 4, 10};

  /** 1, x, y, z, x^2, y^2, z^2, xy, yz, zx up to degree @p degree (at most 2). */
  inline void
  monomials(const unsigned int degree, const double x, const double y, const double z, double *m)
  {
    m[0] = 1.;
    if (degree == 0)
      return;
    m[1] = x;
    m[2] = y;
    m[3] = z;
    if (degree == 1)
      return;
    m[4] = x * x;
    m[5] = y * y;
    m[6] = z * z;
    m[7] = x * y;
    m[8] = y * z;
    m[9] = z * x;
  }

  /**
   * Least-squares fit of a polynomial in three variables to six functions at once
   * (the components of a stress), by the normal equations with scaled columns and
   * Cholesky's decomposition. Coordinates should be of order one.
   */
  class PolynomialFit
  {
  public:
    explicit PolynomialFit(unsigned int degree);

    /** Adds a point with its six values. */
    void
    add(double x, double y, double z, const double *values);

    unsigned int
    n_points() const
    {
      return points;
    }

    /**
     * Computes the coefficients, monomial by monomial: coefficients[6 i + c]
     * belongs to monomial i and function c.
     * @return false, with nothing computed, if the points do not determine the
     *         polynomial well: if a column's part that is orthogonal to the ones
     *         before is below 1e-3 of it.
     */
    bool
    solve(double *coefficients);

  private:
    unsigned int degree, n, points = 0;
    double       matrix[10][10]; ///< lower triangle
    double       right[10][6];
  };
} // namespace tetradapt::compare

#endif
