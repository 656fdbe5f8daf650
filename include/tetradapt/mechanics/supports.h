// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_supports_h
#define tetradapt_mechanics_supports_h

#include "tetradapt/fem/fixed_unknowns.h"
#include "tetradapt/mechanics/held_directions.h"
#include "tetradapt/mechanics/rigid_coupling.h"
#include "tetradapt/scene/scene.h"

#include <deal.II/base/symmetric_tensor.h>

#include <map>

namespace tetradapt::mechanics
{
  using dealii::SymmetricTensor;

  /** A node that a support holds. */
  struct HeldNode
  {
    unsigned int        node;       ///< of the field
    unsigned int        support;    ///< index into the scene's supports
    std::array<bool, 3> components; ///< those that this support prescribes
    double              area; ///< of the support's faces that have the node; 0 at points and lines
    /** Sliding supports, which have no components: the projector on the normals. */
    SymmetricTensor<2, 3> normals;
  };

  /** The displacement components that the supports prescribe, by field node, on every rank. */
  struct PrescribedDisplacement
  {
    /** Of fixed: the node is one of inclined, or it moves with a reference point (see rigid). */
    static constexpr unsigned char is_inclined = fem::FixedUnknowns::is_inclined, is_coupled = 16;

    /** Bit c is set: component c is prescribed. Or is_inclined, or is_coupled; 0: all is free. */
    std::vector<unsigned char>        fixed;
    std::vector<dealii::Tensor<1, 3>> values; ///< prescribed values, zero elsewhere
    /** Nodes that are held in directions that are no components: the projector on these. */
    std::map<unsigned int, SymmetricTensor<2, 3>> inclined;
    /** How uncertain the directions of inclined nodes are, where these are normals of a wall that
     * is known by its faces only; see SlidingNormals::Direction. */
    std::map<unsigned int, double> uncertainty;
    /** Which support holds which node, each pair once: a node may have several. */
    std::vector<HeldNode> held_nodes;
    /** Faces that move with a reference point; where that is prescribed altogether, their nodes
     * are fixed as those of other supports. */
    std::vector<RigidCoupling> rigid;

    bool
    is_fixed(unsigned int node, unsigned int component) const
    {
      return (fixed[node] >> component & 1) != 0;
    }
    /** What is left of @p vector at a node where nothing that is prescribed may change. All of
     * it at coupled nodes, of which this knows nothing. */
    dealii::Tensor<1, 3>
    free_part(unsigned int node, const dealii::Tensor<1, 3> &vector) const;
    /** What components hold at a node, each by its owner. */
    HeldDirections
    directions_at(unsigned int node, const std::array<unsigned int, 3> &owners = {}) const;
    /** Lets a node be held in @p directions and in no others. */
    void
    hold(unsigned int node, const HeldDirections &directions);
    /** Whether every prescribed value is zero. */
    bool
    is_homogeneous() const;
  };

  /** What supports prescribe as constraints of the unknowns that this rank needs of @p space.
   * Where a node slides, one or two of its unknowns depend on the others of the same node.
   * Coupled nodes have no constraints here, see RigidCouplings. Closed. */
  fem::Constraints
  make_constraints(const PrescribedDisplacement &prescribed, const fem::Space &space);

  /** The field nodes on a boundary face: 3, or 6 with those of its edges in the
   * order (0,1) (1,2) (2,0). */
  std::vector<std::array<unsigned int, 6>>
  boundary_face_nodes(const mesh::TetMesh &mesh, const mesh::EdgeTable *edges);

  /**
   * Evaluates the supports on the nodes of the patches that carry their names, or at the points
   * and on the lines that TetMesh::kept has for them.
   * @param edges is null for degree 1.
   * @param surface says what normals sliding supports have, see SlidingNormals.
   * @throws core::InputError if two supports prescribe different values for one
   *         component or direction of one node, naming both and the place, if faces that are
   *         coupled rigidly share nodes with another support, or if a connected
   *         part of the body can still move as a rigid body, naming the motion;
   *         where there are springs the caller has to ask check_rigid_motions() for that.
   */
  PrescribedDisplacement
  prescribe(const std::vector<scene::SupportParameters> &supports,
            const mesh::TetMesh                         &mesh,
            const mesh::EdgeTable                       *edges,
            const scene::MeshParameters                 &surface = {});

  /** The force and the moment that the scene puts on the reference point of a rigid support. */
  std::pair<dealii::Tensor<1, 3>, dealii::Tensor<1, 3>>
  reference_forces(const scene::SupportParameters &support);

  /** Adds what forces and moments at reference points do to the nodes of these, as far as this
   * rank owns them. */
  void
  add_rigid_forces(const std::vector<scene::SupportParameters> &supports,
                   const PrescribedDisplacement                &prescribed,
                   const fem::Space                            &space,
                   fem::Vector                                 &forces);
} // namespace tetradapt::mechanics

#endif
