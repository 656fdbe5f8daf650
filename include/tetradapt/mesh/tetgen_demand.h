// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_tetgen_demand_h
#define tetradapt_mesh_tetgen_demand_h

#include "tetradapt/mesh/sizing.h"
#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::mesh
{
  /** What sizes ask for on an existing mesh. */
  struct SizeDemand
  {
    bool   nothing_new = true; ///< every cell is small enough already
    double n_cells     = 0.;   ///< about what there will be after refinement
  };

  /** Compares every cell with its bounds on the volume and with the mean of its
   * nodes' sizes. The sizes must have passed check_sizing(). */
  SizeDemand
  assess(const TetMesh &mesh, const Sizing &sizing);

  /** About how many cells a bound on their volume makes in a volume. */
  double
  expected_cells(double volume, double volume_bound);

  /** About how many cells of a good shape a thin body of this volume and surface has at
   * least: as long as it is thick. For others it is an underestimate. */
  double
  least_cells(double volume, double area);

  /**
   * Refuses a body so thin that TetGen would work on it for too long.
   *
   * @param time_limit seconds that TetGen may work.
   * @throws InputError with the estimate.
   */
  void
  check_thickness(double volume, double area, double time_limit, const std::string &what);

  /**
   * Refuses sizes that cannot be met, before TetGen runs for hours.
   *
   * @param memory_limit MiB that TetGen may use.
   * @throws InputError if that or TetGen's counters are too small for @p n_cells.
   */
  void
  check_number_of_cells(double n_cells, double memory_limit, const std::string &what);

  /** @throws InputError if there is not one size a point, or one is not positive
   *          and finite; no sizes at all are allowed. */
  void
  check_node_sizes(const std::vector<double>   &sizes,
                   const std::vector<Point<3>> &points,
                   const std::string           &what);

  /** Checks all members of @p sizing for use with @p mesh. @throws InputError. */
  void
  check_sizing(const TetMesh &mesh, const Sizing &sizing, const std::string &what);
} // namespace tetradapt::mesh

#endif
