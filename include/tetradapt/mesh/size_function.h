// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_size_function_h
#define tetradapt_mesh_size_function_h

#include "tetradapt/core/expression.h"
#include "tetradapt/mesh/tetgen.h"

namespace tetradapt::mesh
{
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
   * @param size the wanted mean edge length in the mesh's unit.
   * @throws InputError if h is not positive somewhere, or as Tetgen::refine().
   */
  TetMesh
  mesh_with_size(const Tetgen           &tetgen,
                 const TetMesh          &start,
                 const core::Expression &size,
                 SizeReport             *report = nullptr);
} // namespace tetradapt::mesh

#endif
