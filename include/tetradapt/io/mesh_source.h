// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_mesh_source_h
#define tetradapt_io_mesh_source_h

#include "tetradapt/core/log.h"
#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/mistakes.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::io
{
  /** Checks without meshing whether the points and lines of supports and loads lie in the body that
   * TetGen is to mesh, a box, blocks or a surface: mesh @p number of the scene's list. */
  void
  check_kept_places(const scene::Scene &scene, unsigned int number, scene::Mistakes &mistakes);

  /**
   * Makes mesh @p number of those that the scene lists (0 where it lists one): reads
   * or generates it, meshes surfaces and boxes by TetGen, refines it to the wanted
   * volume or size, and marks on its boundary where supports and loads act; vertices and edges
   * where they act at points and on lines are its TetMesh::kept. Not collective.
   *
   * @throws core::InputError, core::NumericalError as the readers, the surface
   *         checks, TetGen and select_faces() do.
   */
  mesh::TetMesh
  make_mesh(const scene::Scene &scene, unsigned int number, const core::Log &log);
} // namespace tetradapt::io

#endif
