// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_region_figures_h
#define tetradapt_mechanics_region_figures_h

#include "tetradapt/fem/field.h"
#include "tetradapt/mechanics/material_map.h"

namespace tetradapt::mechanics
{
  /** The largest value of something, and where it is. */
  struct LargestValue
  {
    double           value = 0.;
    dealii::Point<3> place; ///< in the body at rest
  };

  /** What is in a region of the mesh, and the largest figures of a solution there. */
  struct RegionFigures
  {
    int           region = 0;
    std::string   name; ///< may be empty
    unsigned long n_cells = 0;
    double        volume = 0., mass = 0.; ///< the latter with the material's density
    LargestValue  displacement;           ///< length of the displacement, over the nodes
    /** sqrt(3/2 s:s) with s the deviator of the stress of the elements. Of degree 2, whose stress
     * is linear in each tetrahedron, over their corners, where it is largest; of degree 1 over
     * their mean stresses, with the centroid as place. */
    LargestValue von_mises;
  };

  /**
   * The figures of all regions of @p displacement's mesh, by region number. Where several places
   * have the largest value but for a millionth, as in symmetric bodies, the place is the one of
   * smallest x, then y, then z. Collective; the same on every rank.
   */
  std::vector<RegionFigures>
  compute_region_figures(const fem::Field &displacement, const MaterialMap &materials);
} // namespace tetradapt::mechanics

#endif
