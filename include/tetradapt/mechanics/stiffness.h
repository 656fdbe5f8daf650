// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_stiffness_h
#define tetradapt_mechanics_stiffness_h

#include "tetradapt/mechanics/block_matrix.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mechanics/supports.h"

namespace tetradapt::mechanics
{
  /** A linear system with the supports built in: constrained rows and columns
   * hold only their diagonal entry, and the right-hand side there is that entry
   * times the prescribed value. */
  struct LinearSystem
  {
    explicit LinearSystem(const DisplacementSpace &space) : matrix(space)
    {
      right_hand_side.reinit(space.vector_layout());
    }
    BlockMatrix matrix;
    Vector      right_hand_side;
  };

  /**
   * The stiffness int B^T C B with the laws' tangents at rest, one a region, and the given nodal
   * forces; 1 quadrature point for degree 1, 4 for degree 2
   * (exact for constant tangents). No communication: each rank
   * assembles the complete rows of its nodes.
   *
   * @param forces may be null, when only the matrix is wanted (a coarser level).
   */
  LinearSystem
  assemble(const DisplacementSpace                 &space,
           const MaterialMap                       &materials,
           const PrescribedDisplacement            &prescribed,
           const std::vector<dealii::Tensor<1, 3>> *forces);
} // namespace tetradapt::mechanics

#endif
