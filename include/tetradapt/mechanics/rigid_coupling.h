// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_rigid_coupling_h
#define tetradapt_mechanics_rigid_coupling_h

#include "tetradapt/fem/field.h"
#include "tetradapt/mechanics/linear_operator.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace tetradapt::mechanics
{
  using dealii::Point;
  using dealii::Tensor;

  /** A small rigid motion about a point: the translation of that, then the rotation vector. */
  using RigidMotion = std::array<double, 6>;

  /** t + R x r. */
  Tensor<1, 3>
  displacement(const RigidMotion &motion, const Tensor<1, 3> &r);

  /**
   * Nodes that move as a rigid body with a reference point: u = t + R x (x - x_ref).
   *
   * Components of (t, R) are prescribed or free. The free ones span a space of nodal displacements,
   * for which there is an orthonormal basis: V^T V = 1 with one column for each.
   */
  struct RigidCoupling
  {
    unsigned int              support; ///< number among the scene's
    Point<3>                  reference;
    std::array<bool, 6>       prescribed{};
    RigidMotion               values{};  ///< of the prescribed components; zero elsewhere
    std::vector<unsigned int> nodes;     ///< of the field, ascending
    std::vector<Point<3>>     positions; ///< theirs
    std::vector<RigidMotion>  basis;     ///< the motions of the columns of V

    /** Finds the basis from all else. */
    void
    make_basis();

    /** The forces on the nodes that are equivalent to @p force and @p moment about the reference
     * point: the smallest ones that do the same work with every rigid motion. */
    std::vector<Tensor<1, 3>>
    nodal_forces(const Tensor<1, 3> &force, const Tensor<1, 3> &moment) const;

    /** The motion that the nodes have in a @p field that is rigid there. Collective. */
    RigidMotion
    motion_of(const fem::Field &field) const;
  };

  /**
   * The couplings of a problem in the local numbers of a space. With the projector Pi = V V^T on
   * coupled nodes and 1 elsewhere, the problem is Pi K Pi w = Pi (f - K g) for u = w + g, where g
   * is what is prescribed. It is not in fem::Constraints: each node depends on six numbers that
   * are no unknowns of the space.
   */
  class RigidCouplings
  {
  public:
    /** Keeps references to both. */
    RigidCouplings(const std::vector<RigidCoupling> &couplings, const fem::Space &space);

    /** There is no free motion: nothing to do. */
    bool
    empty() const
    {
      return n_free == 0;
    }
    /** Of all couplings together. */
    unsigned int
    n_free_motions() const
    {
      return n_free;
    }
    const std::vector<RigidCoupling> &
    all() const
    {
      return couplings;
    }
    /** A node that is coupled and free to move with its reference point. */
    struct Node
    {
      unsigned int local, coupling, index; ///< index: among RigidCoupling::nodes
    };
    /** On this rank, ghosts included. */
    const std::vector<Node> &
    nodes() const
    {
      return local_nodes;
    }
    /** Column @p k of V, among those of the coupling, at a node. */
    Tensor<1, 3>
    column(const Node &node, unsigned int k) const;

    /** V^T x, of all couplings one after the other. One reduction over all ranks. */
    template <typename Number>
    std::vector<double>
    products(const VectorOf<Number> &x) const;

    /** x = Pi x. Collective: one reduction. */
    template <typename Number>
    void
    project(VectorOf<Number> &x) const;

    /** Adds column @p k of V, of all couplings, to the owned nodes of @p x. */
    void
    add_column(unsigned int k, Vector &x) const;

    /** Sets @p x at the coupled nodes owned to V times @p coefficients. */
    template <typename Number>
    void
    set(const std::vector<double> &coefficients, VectorOf<Number> &x) const;

    /** Sets all coupled nodes owned to zero. */
    template <typename Number>
    void
    clear(VectorOf<Number> &x) const;

    /** Adds the prescribed part of the motions, times @p factor, at the nodes owned. */
    void
    add_prescribed(double factor, Vector &x) const;

    /** Whether no motion other than zero is prescribed where others are free. */
    bool
    is_homogeneous() const;

  private:
    const std::vector<RigidCoupling> &couplings;
    MPI_Comm                          communicator;
    std::vector<Node>                 local_nodes; ///< owned ones first
    std::vector<unsigned int>         first;       ///< column of each coupling
    unsigned int                      n_free = 0, n_owned = 0;
  };

  /** Pi K for displacements w = Pi w, which it does not check: the stiffness of the nodes and of
   * the reference points. */
  class RigidlyCoupledOperator : public LinearOperator<double>
  {
  public:
    /** Keeps references. @param matrix has no supports at the coupled nodes. */
    RigidlyCoupledOperator(const LinearOperator<double> &matrix, const RigidCouplings &couplings)
      : matrix(matrix), couplings(couplings)
    {
    }
    void
    vmult(Vector &destination, const Vector &source) const override
    {
      matrix.vmult(destination, source);
      couplings.project(destination);
    }
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_layout() const override
    {
      return matrix.vector_layout();
    }

  private:
    const LinearOperator<double> &matrix;
    const RigidCouplings         &couplings;
  };
} // namespace tetradapt::mechanics

#endif
