// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_curved_volume_h
#define tetradapt_mesh_curved_volume_h

#include "curved_surface.h"

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::mesh
{
  /**
   * The volume of the body whose boundary @p mesh approximates.
   *
   * Every boundary face is cut into n^2 triangles whose corners go to the surfaces and planes
   * that the face, the edge or the point belongs to; the volume inside them is extrapolated from
   * n = 2, 4 and 8 (Romberg), for large meshes from fewer. Of a sphere the relative
   * error is 6e-4 with 8 faces, 1e-5 with 32, 1e-7 with 128.
   *
   * @param surface_of_patch the surface that each patch lies on; null: it is flat.
   * @return 0 if a point does not find its surface.
   */
  double
  curved_volume(const TetMesh &mesh, const std::vector<const CurvedSurface *> &surface_of_patch);
} // namespace tetradapt::mesh

#endif
