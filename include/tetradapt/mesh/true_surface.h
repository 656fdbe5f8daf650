// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_true_surface_h
#define tetradapt_mesh_true_surface_h

#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/mesh_parameters.h"

#include <memory>

namespace tetradapt::mesh
{
  class CurvedSurface;

  /** A point of a body's surface and the unit normal that points out of the body there. */
  struct SurfacePoint
  {
    Point<3>     point;
    Tensor<1, 3> normal;
  };

  /**
   * The surface of a body over the boundary faces of one of its meshes: what the boundary
   * is projected on (BoundaryProjection), where it is; else the faces themselves.
   */
  class TrueSurface
  {
  public:
    /** Keeps a reference to @p mesh, whose patches name their surfaces. Reads the file of a
     * triangulated surface.
     * @throws core::InputError if it cannot be read. */
    TrueSurface(const scene::MeshParameters &parameters, const TetMesh &mesh);
    ~TrueSurface();

    /** Whether a face lies on a surface that the boundary is projected on. */
    bool
    is_projected(unsigned int face) const;

    /**
     * The foot of @p point, which is on boundary face @p face, and the normal there. It is the
     * point itself and the face's normal where the face is not projected, where no foot is
     * found within the face's longest edge, and where the surface's normal is more than 60
     * degrees from the face's. To be asked for inside of faces: at an edge or a vertex the
     * normal is that of this face's surface, not of its neighbours'.
     */
    SurfacePoint
    at(unsigned int face, const Point<3> &point) const;

  private:
    const TetMesh                              &mesh;
    std::vector<std::unique_ptr<CurvedSurface>> surfaces;
    std::vector<const CurvedSurface *>          of_patch; ///< null: none
  };
} // namespace tetradapt::mesh

#endif
