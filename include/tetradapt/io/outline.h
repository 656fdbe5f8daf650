// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_outline_h
#define tetradapt_io_outline_h

#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/mesh_parameters.h"

namespace tetradapt::io
{
  using dealii::Point;

  /**
   * What is known of a scene's body before anything is meshed: the triangles of its surface with
   * their patches, and its regions. A volume mesh from a file is read; what TetGen meshes (a box,
   * blocks, a surface) gives its surface as it is, and bricks that of their box.
   *
   * @param number of the mesh, of those that the parameters list.
   * @return a mesh whose points, faces, patches, regions (each at least once) and region_names
   *         are set; except for a file it has no cells.
   * @throws core::InputError as the readers and geometry::check_surface() do.
   */
  mesh::TetMesh
  outline(const scene::MeshParameters &parameters, unsigned int number);

  /** Points spread over the face @p face, its corners included: those that divide its edges into
   * @p n_parts. */
  std::vector<Point<3>>
  points_on(const mesh::TetMesh &mesh, const mesh::BoundaryFace &face, unsigned int n_parts);
} // namespace tetradapt::io

#endif
