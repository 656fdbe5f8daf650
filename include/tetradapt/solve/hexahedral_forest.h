// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_forest_h
#define tetradapt_solve_hexahedral_forest_h

#include "tetradapt/solve/hexahedral_grid.h"

#include <deal.II/distributed/tria.h>

namespace tetradapt::solve
{
  using dealii::Tensor;

  /** A cell that this rank owns. */
  struct HexahedralCell
  {
    Point<3>     lower;
    Tensor<1, 3> size;       ///< edge lengths
    int          region = 0; ///< region id
    unsigned int level  = 0; ///< how often the brick was cut
    /** Patch of the grid on each side (x-min, x-max, y-min, ...); none inside the body. */
    std::array<unsigned int, 6> patches;

    Point<3>
    at(const Point<3> &unit) const
    {
      return {lower[0] + unit[0] * size[0],
              lower[1] + unit[1] * size[1],
              lower[2] + unit[2] * size[2]};
    }
  };

  /**
   * A forest of octrees, one in each brick of a grid, distributed over the ranks
   * (deal.II's parallel::distributed::Triangulation on p4est). Neighbours differ by
   * one level at most. Material ids are regions; patch p is boundary id p + 1.
   */
  class HexahedralForest
  {
  public:
    using Triangulation = dealii::parallel::distributed::Triangulation<3>;

    /** The bricks themselves. Keeps a reference to @p grid. Collective. */
    HexahedralForest(const HexahedralGrid &grid, MPI_Comm communicator);

    const HexahedralGrid &
    grid() const
    {
      return hexahedral_grid;
    }
    MPI_Comm
    communicator() const
    {
      return hexahedra.get_communicator();
    }
    const Triangulation &
    triangulation() const
    {
      return hexahedra;
    }
    /** The own cells, along a curve through space. */
    const std::vector<HexahedralCell> &
    cells() const
    {
      return cell_list;
    }
    /** The same in the triangulation. */
    const std::vector<Triangulation::active_cell_iterator> &
    own_cells() const
    {
      return iterators;
    }
    /** Over all ranks. */
    unsigned long
    n_cells() const
    {
      return hexahedra.n_global_active_cells();
    }

    /** Cuts the cells with a true entry, and others where neighbours would differ too
     * much. Cells may move to other ranks. Collective. */
    void
    refine(const std::vector<bool> &flags);

  private:
    void
    list_cells();

    const HexahedralGrid                            &hexahedral_grid;
    Triangulation                                    hexahedra;
    std::vector<Triangulation::active_cell_iterator> iterators;
    std::vector<HexahedralCell>                      cell_list;
  };
} // namespace tetradapt::solve

#endif
