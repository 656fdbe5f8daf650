// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_fem_replication_h
#define tetradapt_fem_replication_h

#include "tetradapt/fem/field.h"

/**
 * The one adaptor between distributed fields and nodal values that every rank holds whole. Point
 * location, comparisons across meshes, estimators and files work on the latter; nothing else asks
 * for them.
 */
namespace tetradapt::fem
{
  /** The values of a vector of @p space, one a field node, on every rank. Collective. */
  std::vector<dealii::Tensor<1, 3>>
  replicate(const Space &space, const Vector &vector);

  /** A displacement, with its pressure if it has one, on every rank. Shares the mesh. Collective.
   */
  std::shared_ptr<const mesh::NodalField>
  replicate(const Field &field);

  /** The vector of @p space with the given values, one a field node, at the nodes owned. */
  Vector
  distribute(const Space &space, const std::vector<dealii::Tensor<1, 3>> &values);

  /** A displacement, with its pressure if it has one, in @p space, which must have its mesh and
   * degree. Collective. */
  std::shared_ptr<const Field>
  distribute(const mesh::NodalField &field, std::shared_ptr<const Space> space);

  /** The same in a space that is made for it. Collective. */
  std::shared_ptr<const Field>
  distribute(const mesh::NodalField &field, MPI_Comm communicator);
} // namespace tetradapt::fem

#endif
