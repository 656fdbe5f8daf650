// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_preconditioners_h
#define tetradapt_solve_preconditioners_h

#include "tetradapt/mechanics/matrix_free_stiffness.h"
#include "tetradapt/mechanics/rigid_coupling.h"
#include "tetradapt/mechanics/stiffness.h"
#include "tetradapt/solve/aggregation.h"
#include "tetradapt/solve/flat_nodes.h"

#include <memory>

namespace tetradapt::solve
{
  using Vector = mechanics::Vector;
  template <typename Number>
  using VectorOf = mechanics::VectorOf<Number>;

  /** What conjugate gradients are preconditioned with: symmetric, positive. */
  template <typename Number>
  class ApproximateInverse
  {
  public:
    virtual ~ApproximateInverse() = default;
    /** destination = approximate inverse times source. Collective. */
    virtual void
    vmult(VectorOf<Number> &destination, const VectorOf<Number> &source) const = 0;

    /** From now on, on the finest level of multigrid, smooths by polynomials of this degree: a
     * cycle then takes longer, and there are fewer. Does nothing where nothing is smoothed so. */
    virtual void
    set_smoother_degree(unsigned int /*degree*/)
    {
    }
  };

  using Preconditioner = ApproximateInverse<double>;

  /** An approximate inverse in single precision, for vectors in double precision of any
   * size: @p scale times that of the vector over its largest entry, times this. */
  std::unique_ptr<Preconditioner>
  in_double(std::unique_ptr<ApproximateInverse<float>>                        inverse,
            double                                                            scale,
            const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout);

  /**
   * One cycle of smoothed-aggregation AMG (Vanek, Mandel and Brezina, Computing 56, 1996)
   * with the six rigid motions as near null space, for a matrix of degree 1 times
   * @p scale, which single precision needs near one. Copies what it needs of the matrix.
   * @param couplings of the nodes of the space, if there are any, each of which becomes an
   *        aggregate with its own motions: the finest level leaves them to the next one.
   * @tparam Number is float or double. Collective.
   */
  template <typename Number>
  std::unique_ptr<ApproximateInverse<Number>>
  make_amg(const mechanics::BlockMatrix    &matrix,
           const fem::Space                &space,
           const fem::FixedUnknowns        &fixed,
           double                           scale,
           const mechanics::RigidCouplings *couplings = nullptr);

  /** The same for any matrix with three unknowns a node: its rows, the rigid motions at the
   * owned nodes, and the layout of its columns, which is that of the vectors that it is
   * applied to. Collective. */
  std::unique_ptr<Preconditioner>
  make_amg(const BlockRows<3, 3>                                            &rows,
           const std::vector<NodeModes<3>>                                  &modes,
           const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout);

  /** One cycle of Trilinos' smoothed aggregation (ML) with the six rigid motions as near null
   * space, for a matrix of degree 1. Slower than make_amg() (doc/performance.md), but its coarse
   * levels are Trilinos' own on any number of ranks. Copies the matrix. Collective. */
  std::unique_ptr<Preconditioner>
  make_trilinos_amg(const mechanics::BlockMatrix &matrix,
                    const fem::Space             &space,
                    const fem::FixedUnknowns     &fixed);

  /** What makes up for flat and long cells: source/solve/flat_correction.h. */
  template <typename Number>
  class FlatCorrection;

  /**
   * One V-cycle of p-multigrid for a matrix of degree 2: Chebyshev smoothing with
   * 3x3 block Jacobi there, and degree 1 solved by one cycle of @p coarse_solver. Where cells
   * are flat or long, the smoother has larger blocks and FlatCorrection corrects also.
   * @param flat is null where they are not.
   * @param couplings of the fine space, if there are any: left to @p coarse_solver.
   * @tparam Number is float or double. Keeps references to both spaces.
   */
  template <typename Number>
  std::unique_ptr<ApproximateInverse<Number>>
  make_p_multigrid(std::unique_ptr<mechanics::MatrixFreeStiffness<Number>> fine,
                   const fem::Space                                       &fine_space,
                   const fem::Space                                       &coarse_space,
                   const fem::FixedUnknowns                               &fixed,
                   std::unique_ptr<ApproximateInverse<Number>>             coarse_solver,
                   std::unique_ptr<FlatCorrection<Number>>                 flat,
                   const mechanics::RigidCouplings                        *couplings = nullptr);
} // namespace tetradapt::solve

#endif
