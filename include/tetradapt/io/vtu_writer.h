// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_vtu_writer_h
#define tetradapt_io_vtu_writer_h

#include "tetradapt/mesh/nodal_field.h"

#include <cstdint>

namespace tetradapt::io
{
  /** How exactly an array is stored. */
  enum class Precision
  {
    exact, ///< 64 bits: can be read back bit by bit
    single ///< 32 bits, for looking at
  };

  /**
   * Writes a mesh with data to an XML VTK file (.vtu) for ParaView and for
   * read_displacement_vtu(): appended raw arrays, compressed by zlib where that
   * pays. They are copied when they are added, so that the caller may drop them.
   *
   * The points are the mesh's points, or for a field of degree 2 its nodes, with
   * VTK's quadratic tetrahedra.
   */
  class VtuWriter
  {
  public:
    /** For data at the mesh's points. @p mesh must outlive the writer. */
    explicit VtuWriter(const mesh::TetMesh &mesh);

    /** For data at the nodes of @p field; also adds its values, exactly, as the
     * point array "displacement". @p field must outlive the writer. */
    explicit VtuWriter(const mesh::NodalField &field);

    /** For data at the faces of the boundary of @p mesh: these triangles, in the order of
     * TetMesh::faces, are the cells of the file, and only their points are written. @p mesh must
     * outlive the writer. */
    static VtuWriter
    of_boundary(const mesh::TetMesh &mesh);

    /** Number of values of a point array with one component. */
    unsigned int
    n_points() const
    {
      return n_nodes;
    }

    /**
     * Adds data at points: @p n_components (1, 3, 6, 9) numbers a point, one
     * point after the other. Symmetric tensors have the components xx, yy, zz, xy,
     * yz, xz, which is ParaView's order.
     */
    void
    add_point_data(const std::string         &name,
                   unsigned int               n_components,
                   const std::vector<double> &values,
                   Precision                  precision = Precision::single);

    /** Adds data at cells in the same way. */
    void
    add_cell_data(const std::string         &name,
                  unsigned int               n_components,
                  const std::vector<double> &values,
                  Precision                  precision = Precision::single);

    /** Adds whole numbers at points or cells. */
    void
    add_point_ids(const std::string &name, const std::vector<int> &ids);
    void
    add_cell_ids(const std::string &name, const std::vector<int> &ids);

    /** Adds the cell array "region" and the regions' names. */
    void
    add_regions();

    /** Adds boundary faces, their ids and names as FieldData, from where read_vtu()
     * takes them; ParaView does not show them. */
    void
    add_boundary();

    /** Adds a value or a text that belongs to the whole file. */
    void
    add_value(const std::string &name, double value);
    void
    add_text(const std::string &name, const std::string &text);

    /**
     * Writes the file, whole or not at all.
     * @throws as core::AtomicFile does.
     */
    void
    write(const std::string &file) const;

  private:
    enum class Section
    {
      points,
      cells,
      point_data,
      cell_data,
      field_data
    };
    struct Array
    {
      Section     section;
      std::string xml;   ///< attributes but the offset
      std::string block; ///< header and data as they go into the file
      std::string text;  ///< in place of a block: the content
    };

    template <typename T>
    void
    add_array(Section               section,
              const std::string    &name,
              const char           *type,
              unsigned int          n_components,
              const std::vector<T> &values);
    void
    add_numbers(Section                    section,
                const std::string         &name,
                unsigned int               n_components,
                std::size_t                n_tuples,
                const std::vector<double> &values,
                Precision                  precision);
    /** A writer without geometry yet. */
    VtuWriter(const mesh::TetMesh &mesh, unsigned int n_nodes, unsigned int n_cells);
    void
    add_geometry();
    void
    add_types(std::uint8_t type, unsigned int n_local);

    const mesh::TetMesh    &mesh;
    const mesh::NodalField *field = nullptr;
    unsigned int            n_nodes;
    unsigned int            n_cells; ///< of the file: tetrahedra, or triangles
    std::vector<Array>      arrays;
  };
} // namespace tetradapt::io

#endif
