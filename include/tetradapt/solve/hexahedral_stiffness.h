// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_stiffness_h
#define tetradapt_solve_hexahedral_stiffness_h

#include "tetradapt/mechanics/linear_operator.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/solve/hexahedral_space.h"
#include "tetradapt/solve/trilinos_types.h"

#include <deal.II/base/subscriptor.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

#include <map>

namespace tetradapt::solve
{
  using MatrixFree = dealii::MatrixFree<3, double>;

  /**
   * The stiffness of a HexahedralSpace with the laws' tangents at rest, applied cell by cell
   * without a matrix (dealii::MatrixFree), in the space of unknowns without constraints: it
   * takes the others for zero, or for means of their parents, and gives no forces on them.
   */
  class HexahedralStiffness : public mechanics::LinearOperator<double>, public dealii::Subscriptor
  {
  public:
    /** @param matrix_free has the space and a Gauss rule as numbers @p index, and cells of one
     *        region only in each batch. References to it, to @p space and to @p constraints are
     *        kept. */
    HexahedralStiffness(const HexahedralSpace        &space,
                        const Constraints            &constraints,
                        const mechanics::MaterialMap &materials,
                        const MatrixFree             &matrix_free,
                        unsigned int                  index);

    /** forces = K displacement. Collective. */
    void
    vmult(Vector &forces, const Vector &displacement) const override;

    /** Asked for by deal.II's smoother for a diagonal that is given to it.
     * @throws dealii::ExcNotImplemented */
    double
    el(dealii::types::global_dof_index, dealii::types::global_dof_index) const
    {
      AssertThrow(false, dealii::ExcNotImplemented());
      return 0.;
    }

    /** The owned unknowns, and as ghosts the others of own cells and what these depend on. */
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_layout() const override
    {
      return matrix_free.get_vector_partitioner(index);
    }

    /** What a displacement does in the body, the prescribed part of it included. */
    struct InnerForces
    {
      Vector on_free;     ///< zero on constrained unknowns
      double energy = 0.; ///< a(u,u)
      double size   = 0.; ///< root of the sum of squares of what the cells contribute
    };
    /** @param displacement has its values at constrained unknowns too. Collective. */
    InnerForces
    inner_forces(const Vector &displacement) const;

    /** About the diagonal of K: of what a hanging node gives to its parents, the products of
     * different ones are left out. One for constrained unknowns. Collective. */
    Vector
    diagonal() const;

    /** Adds all of K to a matrix that has its pattern; constrained unknowns get a positive number
     * on the diagonal. Collective. */
    void
    assemble(SparseMatrix &matrix) const;

  private:
    using Cells  = dealii::FEEvaluation<3, -1, 0, 3>; ///< a batch of them
    using Number = dealii::VectorizedArray<double>;

    /** Integrates the stress of a batch's values times the strain of each function. */
    void
    multiply(Cells &cells) const;
    /** The matrix of one cell of a batch, in deal.II's order of its unknowns. */
    dealii::FullMatrix<double>
    cell_matrix(unsigned int batch, unsigned int lane) const;
    /** Calls function(unknowns, matrix, factor of the matrix) for each own cell. */
    template <typename Function>
    void
    for_cell_matrices(const Function &function) const;

    const HexahedralSpace                       &space;
    const Constraints                           &constraints;
    const MatrixFree                            &matrix_free;
    unsigned int                                 index;
    std::map<int, dealii::SymmetricTensor<4, 3>> tangents; ///< of regions
    std::vector<int>                             region_of_batch;
  };
} // namespace tetradapt::solve

#endif
