// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_mesh_totals_h
#define tetradapt_mesh_mesh_totals_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::mesh
{
  /** What a mesh consists of; remeshing must keep all of it but the counts. */
  struct MeshTotals
  {
    struct PatchEntry
    {
      Patch        patch;
      unsigned int n_faces = 0;
      double       area    = 0.;
    };
    struct RegionEntry
    {
      std::string  name; ///< may be empty
      unsigned int n_cells = 0;
      double       volume  = 0.;
    };
    unsigned int               n_points = 0, n_cells = 0, n_faces = 0;
    double                     volume = 0., area = 0.;
    std::vector<PatchEntry>    patches; ///< in the order of TetMesh::patches
    std::map<int, RegionEntry> regions;
  };

  /** Counts, areas and volumes of a finalized mesh. */
  MeshTotals
  mesh_totals(const TetMesh &mesh);

  /**
   * What @p after lost against @p before, a sentence each; empty if all is well:
   * patches that had faces and have none, or are gone; regions that are gone;
   * patches and regions that are new; volumes (of the whole and of each region)
   * and areas (of each patch) that changed by more than @p tolerance times the
   * whole volume or area. Patches are compared by number.
   */
  std::vector<std::string>
  compare_totals(const MeshTotals &before, const MeshTotals &after, double tolerance = 1e-6);

  /** "patch 3, boundary id 7 (clamp), selected by support 'left'" */
  std::string
  describe(const Patch &patch);
} // namespace tetradapt::mesh

#endif
