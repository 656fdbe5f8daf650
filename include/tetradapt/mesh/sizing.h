// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_sizing_h
#define tetradapt_mesh_sizing_h

#include <vector>

namespace tetradapt::mesh
{
  /** What TetGen is told about element sizes. Everything that is empty or zero
   * is not asked for. */
  struct Sizing
  {
    double              max_volume = 0.; ///< one bound for every tetrahedron
    std::vector<double> cell_volumes;    ///< one bound a cell of the refined mesh; <= 0: none
    std::vector<double> node_sizes; ///< edge length to obtain at every point of the refined mesh
  };
} // namespace tetradapt::mesh

#endif
