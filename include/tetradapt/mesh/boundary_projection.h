// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_boundary_projection_h
#define tetradapt_mesh_boundary_projection_h

#include "tetradapt/mesh/point_moves.h"
#include "tetradapt/scene/scene.h"

#include <functional>
#include <memory>
#include <optional>

namespace tetradapt::mesh
{
  class CurvedSurface;
  class SelectionBorders;

  /**
   * Keeps the boundary of a mesh on the true surface of the body, a fine triangulated
   * surface or the zero sets of functions, while the mesh is refined.
   *
   * Patches carry on which surface they lie as one of their selections, with the name
   * surface_name(): so it survives whatever keeps patches. assign() gives it to the
   * faces of a first mesh, project() moves the points of any later one.
   *
   * Where a point goes: with minimal change onto all surfaces that its faces lie on,
   * by Newton's method on their (numerical) gradients; faces that lie on none keep their
   * planes. A point where two surfaces meet so stays on both, and one on the border of a
   * selection (see SelectionBorders) goes to border and surface. On a triangulated
   * surface, points of a mesh edge that bends by more than Mesh/Feature angle go to the
   * surface's own sharp edges. A point stays where it is if it would have to go farther
   * than its longest boundary edge is long (the mesh cuts off a detail that it cannot
   * follow), and goes only as far as move_points() lets it.
   */
  class BoundaryProjection
  {
  public:
    /** @throws InputError if the surface cannot be read, is not closed, or a function
     *         does not parse. */
    explicit BoundaryProjection(const scene::Scene &scene);
    ~BoundaryProjection();

    /**
     * Splits patches so that each lies on one surface or on none. A face lies on the
     * first surface from which its corners are within a hundredth of its longest edge,
     * and whose normal is within 60 degrees of its own; where the mesh was made
     * from the surface itself, every face does. Does nothing to patches that were
     * assigned before.
     *
     * @throws InputError if one of the functions vanishes on no face.
     */
    void
    assign(TetMesh &mesh) const;

    /** Whether faces of @p patch, which assign() has seen, are projected. */
    bool
    is_projected(const Patch &patch) const;

    /** The point of the surface of @p patch, a projected one, that is nearest to @p point; none
     * if it is not found within @p length. */
    std::optional<Point<3>>
    foot(const Patch &patch, const Point<3> &point, double length) const;

    /** Moves the boundary's points to where they belong; those of TetMesh::kept are there. */
    MoveReport
    project(TetMesh &mesh) const;

    /** Volume inside the triangulated surface; 0 where it is not known. */
    double
    true_volume() const;

    /** Volume of the body: true_volume() if it is known, else that within the surfaces near the
     * boundary of @p mesh, which assign() has seen, to a relative error far below that of the mesh
     * (see curved_volume()). 0 if a point of the boundary does not find its surface. */
    double
    body_volume(const TetMesh &mesh) const;

  private:
    /** The surface that a patch lies on; null for none. */
    const CurvedSurface *
    surface_of(const Patch &patch) const;

    bool                                        every_face = false;
    double                                      feature_angle;
    double                                      volume = 0.;
    std::vector<std::unique_ptr<CurvedSurface>> surfaces;
    std::unique_ptr<SelectionBorders>           borders;
  };

  /** The projection that a scene asks for; null for Mesh/Projection = none. */
  std::unique_ptr<BoundaryProjection>
  make_projection(const scene::Scene &scene);

  /**
   * Bounds with which a mesh is refined whose boundary is projected: a radius-edge ratio of
   * 2 at least and no dihedral angle, else as given; without a projection all as given.
   *
   * No edge of a curved wall may be flipped, so that TetGen can mend the flat cells there only
   * by cutting on. On an eighth of a sphere, quadratic, 15 000 tetrahedra wanted, the defaults
   * (1.414, 10 degrees) give 42 000 to 57 000, these bounds 24 000 with the same error.
   */
  scene::TetgenParameters
  quality_for_projection(const scene::TetgenParameters &parameters, bool is_projected);

  /** What mesh_with_size() is to do to each mesh: project() it; nothing for null. Keeps
   * the pointer. */
  std::function<void(TetMesh &)>
  project_on(const BoundaryProjection *projection);
} // namespace tetradapt::mesh

#endif
