// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_embedding_h
#define tetradapt_mesh_embedding_h

#include "tetradapt/core/log.h"
#include "tetradapt/mesh/tet_mesh.h"

#include <string>

namespace tetradapt::mesh
{
  /**
   * Checks that a mesh from a file fills space once: that no two parts of its boundary
   * cross, that no part of the body lies inside another, and that parts which lie on each
   * other share the points of their interface. finalize() sees only what cells that share
   * a triangle do; this sees the rest, which would be solved as if the parts did not know
   * of each other.
   *
   * Parts with a gap between them that is narrower than a thousandth of the triangles
   * there are warned of: it may be meant, but usually two bodies were to be joined.
   *
   * @param mesh a finalized one. @param what names it in messages.
   * @throws core::InputError naming the place and, where it helps, the volumes.
   */
  void
  check_embedding(const TetMesh &mesh, const std::string &what, const core::Log &log);
} // namespace tetradapt::mesh

#endif
