// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_mesh_selection_borders_h
#define tetradapt_source_mesh_selection_borders_h

#include "curved_surface.h"

#include "tetradapt/core/condition.h"
#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/model_parameters.h"

#include <map>
#include <memory>

namespace tetradapt::mesh
{
  /** Where a leaf of a condition changes its sign. */
  class LeafSurface : public CurvedSurface
  {
  public:
    explicit LeafSurface(core::ConditionLeaf leaf) : leaf(std::move(leaf))
    {
    }
    std::string
    name() const override
    {
      return leaf.text;
    }
    LocalPlane
    plane_near(const Point<3> &point, double length) const override;

  private:
    core::ConditionLeaf leaf;
  };

  /**
   * The borders of selections on the boundary of a mesh into which they were cut: edges
   * between faces that a selection has and has not, along the border of a leaf of its
   * expression.
   */
  class SelectionBorders
  {
  public:
    explicit SelectionBorders(
      const std::vector<std::pair<std::string, scene::Selector>> &selectors);

    /**
     * The borders on which points lie, or from which new ones are as far as a chord is from
     * its curve.
     *
     * @param crease_angle in degrees: borders along edges that bend by more are left out,
     *        because they are edges of the body.
     */
    std::map<unsigned int, std::vector<const CurvedSurface *>>
    through_points(const TetMesh &mesh, double crease_angle) const;

  private:
    /** The nearest border of a selection to an edge; null if none is near. */
    const CurvedSurface *
    along_edge(const std::string &selection, const Point<3> &a, const Point<3> &b) const;

    std::map<std::string, std::vector<std::unique_ptr<LeafSurface>>> leaves; ///< by selection
  };
} // namespace tetradapt::mesh

#endif
