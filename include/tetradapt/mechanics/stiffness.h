// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_stiffness_h
#define tetradapt_mechanics_stiffness_h

#include "tetradapt/fem/fixed_unknowns.h"
#include "tetradapt/mechanics/block_matrix.h"
#include "tetradapt/mechanics/spring_matrix.h"
#include "tetradapt/mechanics/tangent_field.h"

namespace tetradapt::mechanics
{
  /** A stiffness matrix with the supports built in: constrained rows and columns hold
   * only their diagonal entry. */
  struct LinearSystem
  {
    /** All zero; @p cell_entries as in BlockMatrix. */
    explicit LinearSystem(const fem::Space          &space,
                          std::vector<unsigned int> *cell_entries = nullptr)
      : matrix(space, cell_entries)
    {
      prescribed_forces.reinit(space.vector_layout());
    }
    BlockMatrix matrix;
    /** What the prescribed displacement takes from the forces on free unknowns. */
    Vector prescribed_forces;
  };

  /**
   * The stiffness int B^T C B and the given nodal forces; 1 quadrature point for
   * degree 1, with the mean of the cell's tangents, 4 for degree 2. Exact for constant
   * tangents; and the matrix of degree 1 is always that of degree 2 in the subspace. No
   * communication: each rank assembles the complete rows of its nodes.
   * @param springs on the nodes of @p space are added; null: none.
   */
  LinearSystem
  assemble(const fem::Space           &space,
           const TangentField         &tangents,
           const fem::FixedUnknowns   &fixed,
           const SpringMatrix<double> *springs = nullptr);

  /** The right-hand side of an assembled system for forces on the nodes of the field:
   * these less those of the prescribed displacement where unknowns are free, else the
   * diagonal entry times the prescribed value. */
  Vector
  right_hand_side(const LinearSystem       &system,
                  const fem::Space         &space,
                  const fem::FixedUnknowns &fixed,
                  const Vector             &forces);
} // namespace tetradapt::mechanics

#endif
