// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_quality_h
#define tetradapt_mesh_quality_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::mesh
{
  /**
   * Shape of a tetrahedron. Lengths are ratios, angles degrees; the value of the
   * regular tetrahedron, the best one, is given with each. A sliver (four
   * points near a circle) has good ratios of its edges and circumradius; only the
   * dihedral angles and the ratios with the height or the inradius show it.
   */
  struct CellQuality
  {
    double min_dihedral    = 0.; ///< smallest angle between two faces; acos(1/3) = 70.529
    double max_dihedral    = 0.; ///< largest one; 70.529
    double radius_edge     = 0.; ///< circumradius / shortest edge (TetGen's -q); sqrt(6)/4 = 0.612
    double aspect_ratio    = 0.; ///< longest edge / smallest height; sqrt(3/2) = 1.225
    double radius_ratio    = 0.; ///< circumradius / (3 inradius); 1
    double shortest_edge   = 0.; ///< length
    double longest_edge    = 0.; ///< length
    double smallest_height = 0.; ///< length
  };

  /** Shape of cell @p cell, which must not be flat. */
  CellQuality
  cell_quality(const TetMesh &mesh, unsigned int cell);

  /** Counts of values in equally wide classes. */
  struct Histogram
  {
    double                    lower = 0., upper = 1.;
    std::vector<unsigned int> counts; ///< values beyond an end are counted in the class there

    void
    add(double value);
  };

  /** Smallest, largest and mean value over the cells, and the worst cell. */
  struct QualityRange
  {
    double       min = 0., max = 0., mean = 0.;
    unsigned int worst_cell = 0;
  };

  /** Shape of a whole mesh. */
  struct MeshQuality
  {
    QualityRange min_dihedral, max_dihedral, radius_edge, aspect_ratio, radius_ratio;
    double       shortest_edge = 0., longest_edge = 0.;
    /** 36 classes of 5 degrees from 0 to 180: all six dihedral angles are not
     * counted, but the smallest and the largest one of every cell. */
    Histogram min_dihedral_histogram, max_dihedral_histogram;
    Histogram aspect_ratio_histogram; ///< 20 classes from 1 to 11
    Histogram radius_ratio_histogram; ///< 20 classes from 1 to 11
  };

  /** Shape of all cells of @p mesh: about 0.2 s for a million. */
  MeshQuality
  mesh_quality(const TetMesh &mesh);
} // namespace tetradapt::mesh

#endif
