// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_equations_h
#define tetradapt_estimate_equilibrated_equations_h

#include "polynomials.h"

namespace tetradapt::estimate
{
  /**
   * The equations that a symmetric stress on Alfeld's split of the unit tetrahedron
   * has to fulfil under given loads, and their solution. A stress has six components
   * xx, yy, zz, yz, zx, xy for each polynomial of each part: coefficient 6 (part *
   * size + polynomial) + component. The loads are numbers also.
   */
  class StressEquations
  {
  public:
    /** Begins with the same traction from both sides of the six triangles inside. */
    StressEquations(unsigned int degree, unsigned int n_loads);

    const PartPolynomials &
    polynomials() const
    {
      return part_polynomials;
    }
    unsigned int
    n_stress() const
    {
      return 24 * part_polynomials.size();
    }

    /** Three equations with nothing in them yet: "sum of tractions = sum of loads",
     * a vector's components. */
    void
    begin();
    /** Adds the stress of polynomial @p k of all parts' times @p normal. */
    void
    add_traction(unsigned int k, const dealii::Tensor<1, 3> &normal);
    /** Adds the divergence at the point of @p part with coordinates @p b there. */
    void
    add_divergence(unsigned int part, const Coordinates &b);
    /** Adds @p factor times the vector that begins with load @p l. */
    void
    add_load(unsigned int l, double factor);

    /**
     * Solves all equations.
     * @param particular for each load the smallest stress, in the norm of L2, that
     *        balances it (as far as loads can be balanced): n_loads rows.
     * @param free_stress an orthonormal basis of the stresses without loads, a row each; null if
     *        it is not wanted.
     */
    void
    solve(std::vector<double> &particular, std::vector<double> *free_stress) const;

  private:
    struct Equation
    {
      std::vector<double> stress, load;
    };
    static void
    make_orthogonal(const std::vector<Equation> &basis, Equation &row);

    PartPolynomials       part_polynomials;
    unsigned int          n_loads;
    std::vector<Equation> rows;
  };

  /** Points i/n, j/n, .. of a triangle and of a tetrahedron: coordinates. */
  std::vector<std::array<double, 3>>
  triangle_nodes(unsigned int n);
  std::vector<Coordinates>
  tetrahedron_nodes(unsigned int n);
} // namespace tetradapt::estimate

#endif
