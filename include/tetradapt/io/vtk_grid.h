// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_vtk_grid_h
#define tetradapt_io_vtk_grid_h

#include "tetradapt/io/mesh_builder.h"

#include <cstdint>

namespace tetradapt::io
{
  /** VTK's numbers of the cell types that are used here. */
  constexpr int vtk_triangle           = 5;
  constexpr int vtk_tetra              = 10;
  constexpr int vtk_quadratic_triangle = 22;
  constexpr int vtk_quadratic_tetra    = 24;

  /** An unstructured grid as VTK files, old and new, describe it. */
  struct VtkGrid
  {
    std::vector<Point<3>>     points;
    std::vector<std::int64_t> types;        ///< one a cell
    std::vector<std::int64_t> ends;         ///< one a cell: end of its nodes in connectivity
    std::vector<std::int64_t> connectivity; ///< point numbers
    std::vector<double>       regions;      ///< one a cell, or empty: 0
    std::vector<double>       boundary_ids; ///< one a cell, or empty: the regions' numbers
  };

  /**
   * The cell arrays, among @p names, that hold region and boundary ids: the first
   * of a list of usual names, capital letters or not.
   *
   * Regions: region, regions, MaterialIDs, MaterialID, material, gmsh:physical,
   * CellEntityIds, medit:ref, ElementBlockIds. Boundary ids: boundary_id,
   * boundary_ids, BoundaryIDs, boundary, patch.
   * @return the two names; empty where there is none.
   */
  std::pair<std::string, std::string>
  id_arrays(const std::vector<std::string> &names);

  /**
   * Tetrahedra and triangles of @p grid, first and second order; vertices and
   * lines are left out, everything else is refused. One node of a quadratic cell
   * that is not in the middle of its edge is refused as well.
   * @param fail throws the message that it is given, with the file's name.
   */
  mesh::TetMesh
  mesh_of_grid(VtkGrid &&grid, const MeshBuilder::Fail &fail);
} // namespace tetradapt::io

#endif
