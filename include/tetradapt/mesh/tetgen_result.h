// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_tetgen_result_h
#define tetradapt_mesh_tetgen_result_h

#include "tetradapt/mesh/mesh_totals.h"
#include "tetradapt/mesh/tetgen_protocol.h"

#include <string>
#include <vector>

namespace tetradapt::mesh
{
  /**
   * TetGen's mesh as a finalized TetMesh with the given patches. Faces without a
   * marker, or with one past the last patch's, lie between regions and are left out.
   *
   * @param what names the mesh in messages.
   * @throws NumericalError if there are no cells, if TetGen lost the marker of a
   *         boundary face, or if the mesh does not stand finalize().
   */
  TetMesh
  mesh_from_reply(const TetgenReply        &reply,
                  const std::vector<Patch> &patches,
                  const std::string        &what);

  /**
   * Compares a mesh to what it was made from.
   *
   * @param tolerance as for compare_totals().
   * @return the relative change of the whole volume.
   * @throws NumericalError saying what changed: the volume, a patch, a region.
   */
  double
  check_kept(const MeshTotals  &before,
             const MeshTotals  &after,
             double             tolerance,
             const std::string &what);
} // namespace tetradapt::mesh

#endif
