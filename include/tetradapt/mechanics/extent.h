// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_extent_h
#define tetradapt_mechanics_extent_h

#include "tetradapt/mechanics/region_figures.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::mechanics
{
  /** How much of a mesh a support or a load acts on. */
  struct Extent
  {
    unsigned long n_faces = 0; ///< of the boundary
    double        area    = 0.;
    unsigned long n_nodes = 0; ///< of the field; of supports only
    unsigned long n_cells = 0; ///< tetrahedra; of loads on the body only
    double        volume  = 0.;
  };

  /** The faces of each patch of a mesh, added up once for all supports and loads. */
  class PatchExtents
  {
  public:
    /** Keeps a reference to @p mesh. */
    explicit PatchExtents(const mesh::TetMesh &mesh);

    /** Faces and area of the patches that carry @p selection, such as "Supports/left". */
    Extent
    of(const std::string &selection) const;

  private:
    const mesh::TetMesh &mesh;
    std::vector<Extent>  patches;
  };

  /** Whether a load of this type acts on regions of the body instead of on faces. */
  bool
  acts_on_body(scene::LoadType type);

  /** Cells and volume of the regions that @p load acts on, from the figures of all regions. */
  Extent
  body_extent(const scene::LoadParameters      &load,
              const mesh::TetMesh              &mesh,
              const std::vector<RegionFigures> &regions);
} // namespace tetradapt::mechanics

#endif
