// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_supports_h
#define tetradapt_mechanics_supports_h

#include "tetradapt/fem/fixed_unknowns.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::mechanics
{
  /** A node that a support holds. */
  struct HeldNode
  {
    unsigned int        node;       ///< of the field
    unsigned int        support;    ///< index into the scene's supports
    std::array<bool, 3> components; ///< those that this support prescribes
    double              area; ///< of the support's faces that have the node; 0 at points and lines
  };

  /** The displacement components that the supports prescribe, a node each. */
  struct PrescribedDisplacement
  {
    std::vector<unsigned char>        fixed;  ///< bit c is set: component c is prescribed
    std::vector<dealii::Tensor<1, 3>> values; ///< prescribed values, zero elsewhere
    /** Which support holds which node, each pair once: a node may have several. */
    std::vector<HeldNode> held_nodes;

    bool
    is_fixed(unsigned int node, unsigned int component) const
    {
      return (fixed[node] >> component & 1) != 0;
    }
    /** Whether every prescribed value is zero. */
    bool
    is_homogeneous() const;
  };

  /** What supports prescribe as constraints of the unknowns that this rank needs of @p space.
   * Closed. */
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
   * @throws core::InputError if two supports prescribe different values for one
   *         component of one node, naming both and the place, or if a connected
   *         part of the body can still move as a rigid body, naming the motion.
   */
  PrescribedDisplacement
  prescribe(const std::vector<scene::SupportParameters> &supports,
            const mesh::TetMesh                         &mesh,
            const mesh::EdgeTable                       *edges);
} // namespace tetradapt::mechanics

#endif
