// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_vtu_reader_h
#define tetradapt_io_vtu_reader_h

#include "tetradapt/mesh/nodal_field.h"

namespace tetradapt::io
{
  /**
   * Reads the mesh of an XML VTK file (.vtu; see VtuFile for what is understood).
   * Which cells and which arrays are used: see mesh_of_grid() and id_arrays(). Boundary
   * ids and names that VtuWriter::add_boundary() wrote are read back. The result
   * still needs finalize().
   */
  mesh::TetMesh
  read_vtu(const std::string &file);

  /** What an earlier run wrote. */
  struct DisplacementFile
  {
    std::shared_ptr<mesh::NodalField>  displacement; ///< on its finalized mesh
    std::map<std::string, double>      values;       ///< scalars of FieldData
    std::map<std::string, std::string> texts;        ///< strings of FieldData
  };

  /**
   * Reads mesh and displacement of a .vtu file: tetrahedra, all of first
   * order or all of second order with straight edges, regions, boundary ids if
   * there are, and the point array "displacement" with three components. Points,
   * cells and every bit of coordinates and displacements come back as VtuWriter
   * wrote them; nodes on edges are numbered as in NodalField, however the file
   * does it.
   *
   * @throws core::InputError as VtuFile does, if the array is missing, if two
   *         cells give the middle of an edge different displacements, and as
   *         finalize() does.
   */
  DisplacementFile
  read_displacement_vtu(const std::string &file);
} // namespace tetradapt::io

#endif
