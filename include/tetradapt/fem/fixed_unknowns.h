// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_fem_fixed_unknowns_h
#define tetradapt_fem_fixed_unknowns_h

#include "tetradapt/fem/space.h"

DEAL_II_NAMESPACE_OPEN
template <typename Number>
class AffineConstraints;
DEAL_II_NAMESPACE_CLOSE

namespace tetradapt::fem
{
  /** deal.II's header of AffineConstraints costs a second to compile: a file that makes, copies
   * or destroys one includes it, the others need not. */
  using Constraints = dealii::AffineConstraints<double>;

  /** Constraints of the unknowns that this rank needs of @p space, none yet, not closed. */
  Constraints
  make_constraints(const Space &space);

  /** The constraints of degree 1 where the nodes of @p space, of degree 1, have @p constraints
   * in @p finer, of degree 2 on the same triangulation. Closed if these are. */
  Constraints
  restrict_to(const Space &space, const Space &finer, const Constraints &constraints);

  /**
   * The unknowns that Constraints fix at a value, in the local numbers of a Space: what kernels
   * take, which work node by node. Local unknown 3 i + c is component c of local node i.
   */
  class FixedUnknowns
  {
  public:
    /**
     * Keeps no reference.
     * @throws dealii::ExcNotImplemented if an unknown depends on others.
     */
    FixedUnknowns(const Space &space, const Constraints &constraints);

    /** Bit c is set: component c of the node is fixed. */
    unsigned char
    components(const unsigned int local_node) const
    {
      return bits[local_node];
    }
    bool
    is_fixed(const unsigned int local_node, const unsigned int c) const
    {
      return (bits[local_node] >> c & 1) != 0;
    }
    /** The value of a fixed unknown. */
    double
    value(const unsigned int local_node, const unsigned int c) const;
    /** All of them, ascending: those of owned nodes first. */
    const std::vector<unsigned int> &
    unknowns() const
    {
      return numbers;
    }
    /** Of unknowns(). */
    const std::vector<double> &
    values() const
    {
      return fixed_values;
    }
    /** Gives the owned unknowns among them their values. */
    void
    distribute(Vector &vector) const;
    /** Whether all values on this rank are zero. */
    bool
    is_homogeneous() const;

  private:
    std::vector<unsigned char> bits; ///< one a local node
    std::vector<unsigned int>  numbers;
    std::vector<double>        fixed_values;
  };
} // namespace tetradapt::fem

#endif
