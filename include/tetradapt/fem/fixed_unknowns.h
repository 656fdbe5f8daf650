// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_fem_fixed_unknowns_h
#define tetradapt_fem_fixed_unknowns_h

#include "tetradapt/fem/space.h"

#include <deal.II/base/symmetric_tensor.h>

#include <array>

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

  /** A node that is held in directions which are no components, as where it slides along an
   * inclined plane: held u = value, with a projector on one or two directions. */
  struct InclinedNode
  {
    unsigned int                  node;  ///< local
    dealii::SymmetricTensor<2, 3> held;  ///< orthogonal projector on the directions that are held
    dealii::Tensor<1, 3>          value; ///< of the displacement in these; held value = value
  };

  /** Builds what is held into a node's own block on the diagonal, row by row:
   * (1 - Q) block (1 - Q) + s Q with Q = @p held and a third of the block's trace for s. Times a
   * vector in the held directions it gives s times that. */
  template <typename Number>
  void
  build_in(const dealii::SymmetricTensor<2, 3> &held, std::array<Number, 9> &block)
  {
    dealii::Tensor<2, 3> K, free = dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>() - held);
    for (unsigned int i = 0; i < 9; ++i)
      K[i / 3][i % 3] = block[i];
    const dealii::Tensor<2, 3> result
      = free * K * free + trace(K) / 3. * dealii::Tensor<2, 3>(held);
    for (unsigned int i = 0; i < 9; ++i)
      block[i] = static_cast<Number>(result[i / 3][i % 3]);
  }

  /**
   * What Constraints prescribe at the nodes, in the local numbers of a Space: what kernels
   * take, which work node by node. Local unknown 3 i + c is component c of local node i.
   *
   * A node either has components that are fixed at values, or it is inclined: then kernels
   * work with projectors Q = InclinedNode::held, (1 - Q) K (1 - Q) in the place of rows and
   * columns that are left out. All vectors stay Cartesian.
   */
  class FixedUnknowns
  {
  public:
    /** Of components(): the node is one of inclined(), and none of its components is fixed. */
    static constexpr unsigned char is_inclined = 8;

    /**
     * Keeps no reference.
     * @throws dealii::ExcNotImplemented if an unknown depends on those of other nodes.
     */
    FixedUnknowns(const Space &space, const Constraints &constraints);

    /** Bit c is set: component c of the node is fixed. Or is_inclined. */
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
    /** All nodes that are held in other directions, ascending: owned ones first. */
    const std::vector<InclinedNode> &
    inclined() const
    {
      return inclined_nodes;
    }
    /** The inclined node @p local_node, which must be one. */
    const InclinedNode &
    inclined_at(unsigned int local_node) const;
    /** What is left of @p vector at a node where nothing that is prescribed may change. */
    dealii::Tensor<1, 3>
    free_part(unsigned int local_node, const dealii::Tensor<1, 3> &vector) const;
    /** All fixed unknowns, ascending: those of owned nodes first. */
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
    /** Gives the owned unknowns what is prescribed. */
    void
    distribute(Vector &vector) const;
    /** Whether all values on this rank are zero. */
    bool
    is_homogeneous() const;

  private:
    std::vector<unsigned char> bits; ///< one a local node
    std::vector<unsigned int>  numbers;
    std::vector<double>        fixed_values;
    std::vector<InclinedNode>  inclined_nodes;
  };
} // namespace tetradapt::fem

#endif
