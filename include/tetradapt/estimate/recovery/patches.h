// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_recovery_patches_h
#define tetradapt_estimate_recovery_patches_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::estimate
{
  /**
   * The cells around every vertex, region by region: a vertex where three regions
   * meet has three patches. Stresses may jump between regions, so a recovered
   * stress must not be smoothed across.
   */
  struct RecoveryPatches
  {
    explicit RecoveryPatches(const mesh::TetMesh &mesh);

    unsigned int
    size() const
    {
      return vertex.size();
    }

    /** The cells of @p patch, enlarged @p layers times by the patches of their
     * vertices (in the same region), in increasing order. */
    void
    cells_of(unsigned int patch, unsigned int layers, std::vector<unsigned int> &result) const;

    /** The cells of @p patch and, until there are @p n_cells, the ones around it (at most two
     * layers of them, in the same region) whose centres are nearest to its vertex, in
     * increasing order. Of cells at equal distances all are taken or none. */
    void
    nearest_cells(const mesh::TetMesh       &mesh,
                  unsigned int               patch,
                  unsigned int               n_cells,
                  std::vector<unsigned int> &result) const;

    std::vector<unsigned int>                vertex;  ///< of each patch
    std::vector<unsigned int>                begin;   ///< of each patch in cells; one more entry
    std::vector<unsigned int>                cells;   ///< increasing in each patch
    std::vector<std::array<unsigned int, 4>> of_cell; ///< the patches of a cell's vertices
    std::vector<unsigned int>                first_of_vertex; ///< patch; one more entry

    /** The cell that has boundary face @p face of @p mesh. */
    unsigned int
    cell_of_face(const mesh::TetMesh &mesh, unsigned int face) const;
  };
} // namespace tetradapt::estimate

#endif
