// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_mesh_face_test_h
#define tetradapt_source_mesh_face_test_h

#include "tetradapt/core/condition.h"
#include "tetradapt/mesh/selection.h"

#include <memory>

namespace tetradapt::mesh
{
  /** What a selector says of faces; its expression is asked once at each corner. */
  class FaceTest
  {
  public:
    /** Keeps a reference to @p mesh. @param name names the selector in messages. */
    FaceTest(const TetMesh         &mesh,
             const scene::Selector &selector,
             const std::string     &name,
             FaceRule               rule);

    bool
    selects(const BoundaryFace &face);

    /** Whether the border of the expression may run through a face that is listed. Always
     * false with FaceRule::interior. */
    bool
    is_straddled(const BoundaryFace &face);

    /** The part of a face's area on which the expression holds, by sampling. */
    double
    share(const BoundaryFace &face) const;

  private:
    bool
    holds_at_corner(unsigned int point);

    /** With the border of an affine leaf decided by its sign < or <=. */
    bool
    holds_inside(const Point<3> &centroid) const;

    bool
    may_cross(const core::ConditionLeaf &leaf, const BoundaryFace &face) const;

    enum : char
    {
      unknown,
      yes,
      no
    };
    const TetMesh                   &mesh;
    FaceRule                         rule;
    std::vector<bool>                in_list; ///< per patch
    std::unique_ptr<core::Condition> condition;
    std::vector<char>                holds_at; ///< per point
    double                           extent   = 0.;
    double                           rounding = 0.; ///< of coordinates
  };
} // namespace tetradapt::mesh

#endif
