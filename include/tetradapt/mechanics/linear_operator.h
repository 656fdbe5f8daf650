// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_linear_operator_h
#define tetradapt_mechanics_linear_operator_h

#include "tetradapt/fem/space.h"

namespace tetradapt::mechanics
{
  using fem::Vector;
  template <typename Number>
  using VectorOf = dealii::LinearAlgebra::distributed::Vector<Number>;

  /**
   * A square matrix on the unknowns of a fem::Space that can be multiplied with a
   * vector, whether its entries are stored or not.
   */
  template <typename Number>
  class LinearOperator
  {
  public:
    virtual ~LinearOperator() = default;

    /** destination = A source. Collective: fetches the ghost values of @p source, and sets
     * them to zero again. */
    virtual void
    vmult(VectorOf<Number> &destination, const VectorOf<Number> &source) const = 0;

    /** Number of rows, and of columns, over all ranks. */
    dealii::types::global_dof_index
    m() const
    {
      return vector_layout()->size();
    }
    dealii::types::global_dof_index
    n() const
    {
      return m();
    }

    /** Layout of its vectors: owned and ghost unknowns of this rank. */
    virtual const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_layout() const = 0;
  };
} // namespace tetradapt::mechanics

#endif
