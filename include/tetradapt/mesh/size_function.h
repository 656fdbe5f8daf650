// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_size_function_h
#define tetradapt_mesh_size_function_h

#include "tetradapt/core/expression.h"
#include "tetradapt/mesh/tetgen.h"

#include <functional>

namespace tetradapt::mesh
{
  /** A wanted edge length in the mesh's unit; must be positive. */
  using SizeFunction = std::function<double(const Point<3> &)>;

  /** Something done to each new mesh: BoundaryProjection::project(), for example. Points
   * may move, nothing else may change. */
  using MeshChange = std::function<void(TetMesh &)>;

  /** How far a mesh follows a wanted size. A cell's size is its equivalent edge
   * (6 sqrt(2) V)^(1/3), what a regular tetrahedron of its volume has. */
  struct SizeReport
  {
    unsigned int  passes          = 0;  ///< calls of TetGen
    double        mean_ratio      = 0.; ///< obtained by wanted size, geometric mean over the cells
    double        largest_ratio   = 0.;
    unsigned long oversized_cells = 0;     ///< larger than 1.5 times the wanted size
    bool          cap_reached     = false; ///< the cap on new points (-S) stopped it
    double        seconds         = 0.;
  };

  /**
   * Refines @p start until its cells follow a size function h(x, y, z): in each
   * pass h is evaluated at every point and inside every cell, and TetGen refines
   * to these sizes; until no cell is larger than 1.5 times the least h at its
   * corners and its centroid, nothing changes any more, or six passes were made.
   * Details of h that are smaller than the cells are found only as the cells
   * around them get smaller. Meshes are never coarsened.
   *
   * @param change is applied to every mesh that TetGen made; may be empty.
   * @param smallest_step of new by old size in one pass (and more passes then), 0: none.
   *        TetGen takes sizes for linear in each old cell, and so makes cells along
   *        the whole of a large cell of which one corner wants small ones. Measured: on a beam
   *        with small cells at two edges, begun with 8 points, 15 561 tetrahedra without, 5 179
   *        with 0.4, for sizes that 3 255 would have on average.
   * @throws as Tetgen::refine(), and what @p size and @p change throw.
   */
  TetMesh
  mesh_with_size(const Tetgen       &tetgen,
                 const TetMesh      &start,
                 const SizeFunction &size,
                 SizeReport         *report        = nullptr,
                 const MeshChange   &change        = {},
                 double              smallest_step = 0.);

  /** The same for an expression. @throws InputError if it is not positive somewhere. */
  TetMesh
  mesh_with_size(const Tetgen           &tetgen,
                 const TetMesh          &start,
                 const core::Expression &size,
                 SizeReport             *report = nullptr,
                 const MeshChange       &change = {});
} // namespace tetradapt::mesh

#endif
