// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_matrix_free_stiffness_h
#define tetradapt_mechanics_matrix_free_stiffness_h

#include "tetradapt/mechanics/linear_operator.h"
#include "tetradapt/mechanics/spring_matrix.h"
#include "tetradapt/mechanics/supports.h"
#include "tetradapt/mechanics/tangent_field.h"

#include <deal.II/base/aligned_vector.h>

#include <optional>

namespace tetradapt::mechanics
{
  enum class TangentForm; // of the kernel

  /**
   * The stiffness int B^T C B of degree 2 with the supports built in, without its entries:
   * a product integrates over the cells again, many cells at a time in the lanes of vector
   * registers, from nine numbers of geometry and the tangent. Four quadrature points, which
   * is exact for constant tangents. With full tangents the stiffness is int dv : dP/dF : du. Equal
   * to assemble()'s matrix to rounding: constrained rows and columns hold only their diagonal
   * entry.
   *
   * On several ranks every rank works on all cells that touch its nodes, so that a product
   * fetches ghost values but sends no results.
   *
   * @tparam Number is double, or float for preconditioners.
   */
  template <typename Number>
  class MatrixFreeStiffness : public LinearOperator<Number>
  {
  public:
    using Block = std::array<Number, 9>; ///< row by row

    /**
     * @param scale multiplies the matrix; single precision needs entries near one.
     * @param springs on the nodes of @p space are added; null: none.
     * Keeps a reference to @p space, whose degree must be 2. No communication.
     */
    MatrixFreeStiffness(const fem::Space           &space,
                        const TangentField         &tangents,
                        const fem::FixedUnknowns   &fixed,
                        double                      scale   = 1.,
                        const SpringMatrix<double> *springs = nullptr);

    void
    vmult(VectorOf<Number> &destination, const VectorOf<Number> &source) const override;

    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_layout() const override
    {
      return space.vector_layout();
    }

    /** The block of each owned node on the diagonal, supports built in. */
    const std::vector<Block> &
    diagonal_blocks() const
    {
      return diagonal;
    }

    /** The right-hand side for forces on the nodes of the field: these less those of the
     * prescribed displacement where unknowns are free, else the diagonal entry times the
     * prescribed value. No communication. */
    VectorOf<Number>
    right_hand_side(const Vector &forces) const;

  private:
    void
    store_cells(const TangentField &tangents, double scale);
    void
    compute_diagonal();
    /** Adds the forces of the batches from @p begin to @p end, supports left aside. */
    void
    add_forces(unsigned int begin, unsigned int end, const Number *x, Number *y) const;

    const fem::Space                   &space;
    fem::FixedUnknowns                  fixed;
    unsigned int                        n_batches     = 0;
    unsigned int                        n_own_batches = 0; ///< these, first, have no ghosts
    TangentForm                         form;              ///< how tangents are stored
    dealii::AlignedVector<unsigned>     nodes;
    std::vector<unsigned char>          at_end; ///< of batches: whether they have the last node
    dealii::AlignedVector<Number>       gradients, tangent_values;
    std::vector<Block>                  diagonal;
    std::optional<SpringMatrix<Number>> springs; ///< empty: none
    mutable VectorOf<Number> masked; ///< made where a source has values at fixed unknowns
  };
} // namespace tetradapt::mechanics

#endif
