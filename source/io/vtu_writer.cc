// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/vtu_writer.h"

#include "tetradapt/core/atomic_file.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/io/byte_source.h"
#include "tetradapt/io/scalar_types.h"
#include "tetradapt/io/vtk_grid.h"

#include <algorithm>
#include <set>

namespace tetradapt::io
{
  using dealii::Tensor;

  namespace
  {
    std::string
    escaped(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        if (c == '&')
          result += "&amp;";
        else if (c == '<')
          result += "&lt;";
        else if (c == '"')
          result += "&quot;";
        else
          result += c;
      return result;
    }



    /** "7 left hand\n" for each entry. */
    std::string
    lines_of(const std::map<int, std::string> &names)
    {
      std::string text;
      for (const auto &[id, name] : names)
        text += std::to_string(id) + " " + name + "\n";
      return text;
    }
  } // namespace



  VtuWriter::VtuWriter(const mesh::TetMesh &mesh,
                       const unsigned int   n_nodes,
                       const unsigned int   n_cells)
    : mesh(mesh), n_nodes(n_nodes), n_cells(n_cells)
  {
  }



  VtuWriter::VtuWriter(const mesh::TetMesh &mesh) : VtuWriter(mesh, mesh.n_points(), mesh.n_cells())
  {
    add_geometry();
  }



  VtuWriter
  VtuWriter::of_boundary(const mesh::TetMesh &mesh)
  {
    std::vector<std::int32_t> number(mesh.n_points(), -1), connectivity;
    std::vector<double>       coordinates;
    connectivity.reserve(3 * mesh.faces.size());
    std::int32_t n_points = 0;
    for (const mesh::BoundaryFace &face : mesh.faces)
      for (const unsigned int v : face.vertices)
        {
          if (number[v] < 0)
            {
              number[v]         = n_points++;
              const Point<3> &p = mesh.points[v];
              coordinates.insert(coordinates.end(), {p[0], p[1], p[2]});
            }
          connectivity.push_back(number[v]);
        }
    VtuWriter writer(mesh, n_points, mesh.faces.size());
    writer.add_array(Section::points, "Points", "Float64", 3, coordinates);
    writer.add_array(Section::cells, "connectivity", "Int32", 1, connectivity);
    writer.add_types(vtk_triangle, 3);
    return writer;
  }



  VtuWriter::VtuWriter(const mesh::NodalField &field)
    : mesh(field.mesh()), field(&field), n_nodes(field.n_nodes()), n_cells(mesh.n_cells())
  {
    add_geometry();
    std::vector<double> displacement;
    displacement.reserve(3 * field.values.size());
    for (const Tensor<1, 3> &u : field.values)
      displacement.insert(displacement.end(), {u[0], u[1], u[2]});
    add_point_data("displacement", 3, displacement, Precision::exact);
  }



  void
  VtuWriter::add_geometry()
  {
    std::vector<double> coordinates;
    coordinates.reserve(3 * static_cast<std::size_t>(n_nodes));
    for (unsigned int n = 0; n < n_nodes; ++n)
      {
        const Point<3> p = field != nullptr ? field->node_position(n) : mesh.points[n];
        coordinates.insert(coordinates.end(), {p[0], p[1], p[2]});
      }
    add_array(Section::points, "Points", "Float64", 3, coordinates);

    const bool                quadratic = field != nullptr && field->degree() == 2;
    const unsigned int        n_local   = quadratic ? 10 : 4;
    std::vector<std::int32_t> connectivity;
    connectivity.reserve(n_local * mesh.cells.size());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int i = 0; i < n_local; ++i)
        connectivity.push_back(i < 4 ? mesh.cells[c][i] : field->node(c, i));
    add_array(Section::cells, "connectivity", "Int32", 1, connectivity);

    add_types(quadratic ? vtk_quadratic_tetra : vtk_tetra, n_local);
  }



  void
  VtuWriter::add_types(const std::uint8_t type, const unsigned int n_local)
  {
    std::vector<std::int64_t> offsets(n_cells);
    for (std::size_t c = 0; c < offsets.size(); ++c)
      offsets[c] = n_local * (c + 1);
    add_array(Section::cells, "offsets", "Int64", 1, offsets);
    add_array(Section::cells, "types", "UInt8", 1, std::vector<std::uint8_t>(n_cells, type));
  }



  template <typename T>
  void
  VtuWriter::add_array(const Section         section,
                       const std::string    &name,
                       const char           *type,
                       const unsigned int    n_components,
                       const std::vector<T> &values)
  {
    std::string xml = "type=\"" + std::string(type) + "\" Name=\"" + escaped(name) + "\"";
    if (n_components != 1)
      xml += " NumberOfComponents=\"" + std::to_string(n_components) + "\"";
    if (section == Section::field_data)
      xml += " NumberOfTuples=\"" + std::to_string(values.size() / n_components) + "\"";

    // Ids and offsets shrink to a hundredth or a sixth at once. Point numbers of
    // cells and faces, and the bits of computed floating-point numbers, are so close to random
    // that zlib takes ten times as long as writing them, to save 40 and 10 percent.
    const bool shrink
      = !std::is_floating_point_v<T> && name != "connectivity" && name != "boundary_faces";
    arrays.push_back({section,
                      xml,
                      compressed_array(reinterpret_cast<const unsigned char *>(values.data()),
                                       values.size() * sizeof(T),
                                       shrink),
                      ""});
  }



  void
  VtuWriter::add_numbers(const Section              section,
                         const std::string         &name,
                         const unsigned int         n_components,
                         const std::size_t          n_tuples,
                         const std::vector<double> &values,
                         const Precision            precision)
  {
    if (n_components == 0 || values.size() != n_components * n_tuples)
      throw core::InputError("The array '" + name + "' for a .vtu file has "
                             + std::to_string(values.size()) + " numbers instead of "
                             + std::to_string(n_tuples) + " x " + std::to_string(n_components)
                             + ".");
    if (precision == Precision::exact)
      add_array(section, name, "Float64", n_components, values);
    else
      add_array(
        section, name, "Float32", n_components, std::vector<float>(values.begin(), values.end()));
  }



  void
  VtuWriter::add_point_data(const std::string         &name,
                            const unsigned int         n_components,
                            const std::vector<double> &values,
                            const Precision            precision)
  {
    add_numbers(Section::point_data, name, n_components, n_nodes, values, precision);
  }



  void
  VtuWriter::add_cell_data(const std::string         &name,
                           const unsigned int         n_components,
                           const std::vector<double> &values,
                           const Precision            precision)
  {
    add_numbers(Section::cell_data, name, n_components, n_cells, values, precision);
  }



  void
  VtuWriter::add_point_ids(const std::string &name, const std::vector<int> &ids)
  {
    if (ids.size() != n_nodes)
      throw core::InputError("The array '" + name + "' for a .vtu file has "
                             + std::to_string(ids.size()) + " numbers instead of "
                             + std::to_string(n_nodes) + ".");
    add_array(Section::point_data, name, "Int32", 1, ids);
  }



  void
  VtuWriter::add_cell_ids(const std::string &name, const std::vector<int> &ids)
  {
    if (ids.size() != n_cells)
      throw core::InputError("The array '" + name + "' for a .vtu file has "
                             + std::to_string(ids.size()) + " numbers instead of "
                             + std::to_string(n_cells) + ".");
    add_array(Section::cell_data, name, "Int32", 1, ids);
  }



  void
  VtuWriter::add_regions()
  {
    add_cell_ids("region", mesh.regions);
    if (!mesh.region_names.empty())
      add_text("region_names", lines_of(mesh.region_names));
  }



  void
  VtuWriter::add_boundary()
  {
    std::vector<std::int32_t> faces, ids;
    faces.reserve(3 * mesh.faces.size());
    ids.reserve(mesh.faces.size());
    for (const mesh::BoundaryFace &face : mesh.faces)
      {
        faces.insert(faces.end(), face.vertices.begin(), face.vertices.end());
        ids.push_back(mesh.patches[face.patch].boundary_id);
      }
    add_array(Section::field_data, "boundary_faces", "Int32", 3, faces);
    add_array(Section::field_data, "boundary_ids", "Int32", 1, ids);
    std::map<int, std::string> names;
    for (const mesh::Patch &patch : mesh.patches)
      if (!patch.name.empty())
        names[patch.boundary_id] = patch.name;
    if (!names.empty())
      add_text("boundary_names", lines_of(names));
  }



  void
  VtuWriter::add_value(const std::string &name, const double value)
  {
    add_array(Section::field_data, name, "Float64", 1, std::vector<double>{value});
  }



  void
  VtuWriter::add_text(const std::string &name, const std::string &text)
  {
    std::string codes;
    for (const unsigned char c : text)
      codes += std::to_string(c) + " ";
    arrays.push_back({Section::field_data,
                      "type=\"String\" Name=\"" + escaped(name) + "\" NumberOfTuples=\"1\"",
                      "",
                      codes + "0"});
  }



  void
  VtuWriter::write(const std::string &file) const
  {
    core::AtomicFile output(file);
    std::ostream    &out = output.stream();
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        << "byte_order=\"" << (is_little_endian() ? "LittleEndian" : "BigEndian")
        << "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
        << "<UnstructuredGrid>\n";

    // Blocks lie in the file in the order in which arrays were added.
    const auto write_section = [&](const Section section, const char *element) {
      out << '<' << element << ">\n";
      std::size_t offset = 0;
      for (const Array &array : arrays)
        {
          if (array.section == section && array.block.empty())
            out << "<Array " << array.xml << " format=\"ascii\">" << array.text << "</Array>\n";
          else if (array.section == section)
            out << "<DataArray " << array.xml << " format=\"appended\" offset=\"" << offset
                << "\"/>\n";
          offset += array.block.size();
        }
      out << "</" << element << ">\n";
    };
    write_section(Section::field_data, "FieldData");
    out << "<Piece NumberOfPoints=\"" << n_nodes << "\" NumberOfCells=\"" << n_cells << "\">\n";
    write_section(Section::points, "Points");
    write_section(Section::cells, "Cells");
    write_section(Section::point_data, "PointData");
    write_section(Section::cell_data, "CellData");
    out << "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    for (const Array &array : arrays)
      out << array.block;
    out << "\n</AppendedData>\n</VTKFile>\n";
    output.commit();
  }
} // namespace tetradapt::io
