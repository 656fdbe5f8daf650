// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_curved_faces_h
#define tetradapt_mesh_curved_faces_h

#include "curved_surface.h"

namespace tetradapt::mesh
{
  /**
   * The true surface over every boundary face (see TetMesh::curved_faces).
   *
   * Over a smooth surface the points and normals are the feet of the face's vertices and of the
   * middles of its edges. On a triangulated one, whose normal jumps from triangle to triangle,
   * they are taken at three points inside the face and continued linearly: where a face is larger
   * than the triangles it gets their trend, where it is smaller it gets its own triangle's
   * normal. Where no foot is found, or the normal is more than 60 degrees from that of
   * the face, the face stays as it is.
   *
   * @param surface_of the surface of each face; null: none.
   */
  std::vector<CurvedFace>
  curved_faces(const TetMesh &mesh, const std::vector<const CurvedSurface *> &surface_of);
} // namespace tetradapt::mesh

#endif
