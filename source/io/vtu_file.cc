// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/vtu_file.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/io/file_scanner.h"
#include "tetradapt/io/scalar_types.h"

#include <algorithm>

namespace tetradapt::io
{
  VtuFile::VtuFile(const std::string &file) : file(file), content(read_file(file))
  {
    parse_document();
    read_attributes();
    find_piece();
  }



  std::string
  VtuFile::line_of(const std::ptrdiff_t offset) const
  {
    const auto end = std::min<std::size_t>(std::max<std::ptrdiff_t>(offset, 0), content.size());
    return ", line " + std::to_string(1 + std::count(content.begin(), content.begin() + end, '\n'));
  }



  void
  VtuFile::fail(const pugi::xml_node where, const std::string &message) const
  {
    const std::string name = where.attribute("Name").value();
    throw core::InputError("'" + file + "'" + (where ? line_of(where.offset_debug()) : "") + ": "
                           + (name.empty() ? "" : "array " + excerpt(name) + ": ") + message);
  }



  void
  VtuFile::find_appended(const std::size_t begin)
  {
    // What follows the element's first tag is no XML: only this tag is parsed.
    const std::size_t end = content.find('>', begin);
    if (end == std::string::npos)
      fail({}, "the element AppendedData is cut off.");
    pugi::xml_document tag;
    if (!tag.load_string((content.substr(begin, end - begin) + "/>").c_str()))
      fail({}, "the element AppendedData is damaged.");
    const std::string encoding = tag.first_child().attribute("encoding").value();
    if (encoding != "raw" && encoding != "base64")
      fail({}, "appended data have the unknown encoding " + excerpt(encoding) + ".");
    appended_base64              = encoding == "base64";
    const std::size_t underscore = content.find_first_not_of(" \t\r\n", end + 1);
    if (underscore == std::string::npos || content[underscore] != '_')
      fail({}, "appended data do not begin with an underscore.");
    appended = std::string_view(content).substr(underscore + 1);
  }



  void
  VtuFile::parse_document()
  {
    const std::size_t begin = content.find("<AppendedData");
    xml                     = content.substr(0, begin);
    if (begin != std::string::npos)
      {
        find_appended(begin);
        xml += "</VTKFile>";
      }
    const auto result = document.load_buffer_inplace(xml.data(), xml.size());
    if (!result)
      throw core::InputError("'" + file + "'" + line_of(result.offset)
                             + ": this is not XML, or it is cut off: " + result.description()
                             + ".");
  }



  void
  VtuFile::read_attributes()
  {
    const pugi::xml_node root = document.child("VTKFile");
    if (!root)
      fail(document.first_child(), "the element VTKFile is missing: this is not a VTK file.");
    const std::string type = root.attribute("type").value();
    if (type != "UnstructuredGrid")
      fail(root, "the file holds " + excerpt(type) + "; only 'UnstructuredGrid' can be used.");

    const std::string order  = root.attribute("byte_order").as_string("LittleEndian");
    const std::string header = root.attribute("header_type").as_string("UInt32");
    const std::string zip    = root.attribute("compressor").value();
    if (order != "LittleEndian" && order != "BigEndian")
      fail(root, "unknown byte_order " + excerpt(order) + ".");
    if (header != "UInt32" && header != "UInt64")
      fail(root, "unknown header_type " + excerpt(header) + ".");
    if (!zip.empty() && zip != "vtkZLibDataCompressor")
      fail(root,
           "the data are compressed by " + excerpt(zip)
             + "; only 'vtkZLibDataCompressor' can be read. Save the file with this or none.");
    layout.swap         = (order == "LittleEndian") != is_little_endian();
    layout.header_bytes = header == "UInt64" ? 8 : 4;
    layout.compressed   = !zip.empty();

    grid = root.child("UnstructuredGrid");
    if (!grid)
      fail(root, "the element UnstructuredGrid is missing.");
  }



  void
  VtuFile::find_piece()
  {
    for (const pugi::xml_node candidate : grid.children("Piece"))
      {
        if (candidate.attribute("NumberOfCells").as_ullong() == 0)
          continue;
        if (piece)
          fail(candidate, "the grid has more than one piece. Merge them and save it again.");
        piece = candidate;
      }
    if (!piece)
      fail(grid, "the grid has no cells.");
  }



  std::size_t
  VtuFile::size_attribute(const char *name) const
  {
    std::int64_t n;
    if (!parse(std::string_view(piece.attribute(name).value()), n) || n < 0)
      fail(piece, std::string(name) + " is missing or not a number.");
    return n;
  }



  pugi::xml_node
  VtuFile::section(const std::string &name) const
  {
    if (name != "FieldData")
      return piece.child(name.c_str());
    return grid.child("FieldData") ? grid.child("FieldData") : piece.child("FieldData");
  }



  std::vector<std::string>
  VtuFile::names(const std::string &section_name) const
  {
    std::vector<std::string> result;
    for (const pugi::xml_node child : section(section_name).children())
      if (child.attribute("Name"))
        result.emplace_back(child.attribute("Name").value());
    return result;
  }



  pugi::xml_node
  VtuFile::array(const std::string &section_name, const std::string &name) const
  {
    for (const pugi::xml_node child : section(section_name).children())
      if (child.attribute("Name").value() == name)
        return child;
    fail(section(section_name) ? section(section_name) : piece,
         "there is no array '" + name + "' in " + section_name + ".");
  }



  pugi::xml_node
  VtuFile::coordinates() const
  {
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    if (!array)
      fail(piece, "there are no Points.");
    return array;
  }



  bool
  VtuFile::is_text(const pugi::xml_node array)
  {
    return array.attribute("type").value() == std::string("String");
  }



  std::string
  VtuFile::text(const pugi::xml_node array) const
  {
    std::string result;
    for (const std::int64_t code : integers(array))
      {
        if (code == 0)
          break;
        result += static_cast<char>(code);
      }
    return result;
  }



  template <typename T>
  std::vector<T>
  VtuFile::text_values(const pugi::xml_node array) const
  {
    std::vector<T>   values;
    std::string_view rest = array.child_value();
    for (rest = trimmed(rest); !rest.empty();)
      {
        const std::size_t n = std::min(rest.find_first_of(" \t\r\n\v\f"), rest.size());
        T                 value;
        if (!parse(rest.substr(0, n), value))
          fail(array, excerpt(rest.substr(0, n)) + " is not a number, or not of its type.");
        values.push_back(value);
        rest.remove_prefix(n);
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n\v\f"), rest.size()));
      }
    return values;
  }



  std::uint64_t
  VtuFile::most_numbers(const pugi::xml_node array) const
  {
    // As a bound on memory only: whoever uses the numbers checks how many there are.
    constexpr std::uint64_t text = 1 << 24, numbers_a_point = 64, field = 1 << 20;
    if (is_text(array))
      return text;
    const std::uint64_t tuples = array.attribute("NumberOfTuples").as_ullong();
    if (tuples > 0)
      return std::min<std::uint64_t>(tuples, std::uint64_t(1) << 40) * n_components(array);
    return numbers_a_point * (n_points() + n_cells()) + field;
  }



  std::vector<unsigned char>
  VtuFile::bytes(const pugi::xml_node array, const std::uint64_t most) const
  {
    const std::function<void(const std::string &)> complain
      = [&](const std::string &message) { fail(array, message); };
    const std::string format = array.attribute("format").as_string("ascii");
    if (format == "binary")
      {
        ByteSource source(array.child_value(), true, complain);
        return read_array(source, layout, most, complain);
      }
    if (format != "appended")
      fail(array, "unknown format " + excerpt(format) + ".");

    std::int64_t offset;
    if (!parse(std::string_view(array.attribute("offset").value()), offset) || offset < 0
        || static_cast<std::size_t>(offset) >= appended.size())
      fail(array,
           "the offset " + excerpt(array.attribute("offset").value()) + " is not within the "
             + std::to_string(appended.size()) + " bytes of appended data: the file is cut off.");
    ByteSource source(appended.substr(offset), appended_base64, complain);
    return read_array(source, layout, most, complain);
  }



  template <typename T>
  std::vector<T>
  VtuFile::values(const pugi::xml_node array, const std::size_t n) const
  {
    std::vector<T> result;
    if (array.attribute("format").as_string("ascii") == std::string("ascii"))
      result = text_values<T>(array);
    else
      {
        ScalarType        type;
        const std::string type_name = array.attribute("type").value();
        if (is_text(array))
          type = ScalarType::int8;
        else if (!xml_scalar_type(type_name, type))
          fail(array, "numbers of type " + excerpt(type_name) + " cannot be read.");
        const std::vector<unsigned char> data
          = bytes(array, (n > 0 ? n : most_numbers(array)) * size_of(type));
        if (data.size() % size_of(type) != 0)
          fail(array,
               "its " + std::to_string(data.size()) + " bytes are not a whole number of "
                 + type_name + ".");
        result.resize(data.size() / size_of(type));
        convert(type, data.data(), result.size(), layout.swap, result.data());
      }
    if (n != 0 && result.size() != n)
      fail(array,
           "it holds " + std::to_string(result.size()) + " numbers instead of " + std::to_string(n)
             + ".");
    return result;
  }



  std::vector<double>
  VtuFile::numbers(const pugi::xml_node array, const std::size_t n) const
  {
    return values<double>(array, n);
  }



  std::vector<std::int64_t>
  VtuFile::integers(const pugi::xml_node array, const std::size_t n) const
  {
    return values<std::int64_t>(array, n);
  }
} // namespace tetradapt::io
