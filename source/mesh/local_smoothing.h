// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_local_smoothing_h
#define tetradapt_mesh_local_smoothing_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::mesh
{
  /** The mean ratio above which a cell is not bettered. */
  constexpr double good_mean_ratio = 0.5;

  /** Mean ratio of a cell of a mesh. */
  double
  mean_ratio(const TetMesh &mesh, unsigned int cell);

  /** Moves points inside a mesh to where the cells around them are better. */
  class LocalSmoothing
  {
  public:
    /** Keeps a reference. Points on the boundary and between regions are not free. */
    explicit LocalSmoothing(TetMesh &mesh);

    bool
    is_free(unsigned int point) const
    {
      return free_points[point] != 0;
    }
    void
    fix(unsigned int point)
    {
      free_points[point] = 0;
    }

    /** The cells around a point: first and one past the last. */
    std::pair<const unsigned int *, const unsigned int *>
    cells_around(unsigned int point) const
    {
      return {around.data() + first[point], around.data() + first[point + 1]};
    }

    /** Free points that at most @p n_layers cells in a row lead to from @p seeds,
     * nearest first. */
    std::vector<unsigned int>
    free_points_near(const std::vector<unsigned int> &seeds, unsigned int n_layers) const;

    /** Puts a free corner of a bad cell where the sum of defects around it, (good/q - 1)^2 of
     * mean ratios q, is least. @return whether it moved. */
    bool
    improve(unsigned int cell, unsigned int point);

  private:
    double
    defect_around(unsigned int point) const;
    Point<3>
    centre_around(unsigned int point) const;
    Tensor<1, 3>
    away_from_opposite(unsigned int cell, unsigned int point) const;

    TetMesh                  &mesh;
    std::vector<unsigned int> first, around; ///< cells around points
    std::vector<char>         free_points;
  };
} // namespace tetradapt::mesh

#endif
