// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_surface_point_h
#define tetradapt_mesh_surface_point_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::mesh
{
  /** A point of a body's surface and the unit normal that points out of the body there. */
  struct SurfacePoint
  {
    Point<3>     point;
    Tensor<1, 3> normal;
  };

  /**
   * The point of the body's surface over a point of a boundary face. With a projection this is
   * the surface that the boundary is projected on, up to the third power of the edge length;
   * else the face itself. To be asked for inside of faces: at an edge or a vertex the normal is
   * that of face @p face, not of its neighbours.
   *
   * @param face number of the boundary face.
   * @param point on the face.
   */
  SurfacePoint
  surface_point(const TetMesh &mesh, unsigned int face, const Point<3> &point);

  /** Whether the surface over the faces of @p mesh may be curved. */
  inline bool
  has_curved_faces(const TetMesh &mesh)
  {
    return !mesh.curved_faces.empty() && mesh.curved_faces.size() == mesh.faces.size();
  }
} // namespace tetradapt::mesh

#endif
