// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_vtu_file_h
#define tetradapt_io_vtu_file_h

#include "tetradapt/io/byte_source.h"

#include <pugixml.hpp>

#include <cstdint>

namespace tetradapt::io
{
  /**
   * The arrays of an XML VTK file with an unstructured grid in one piece: as
   * text, base64 in place, or appended raw or in base64; compressed by zlib or
   * not; with headers of 32 or 64 bits; any type of number; either order of bytes.
   *
   * All functions throw core::InputError, with the line of the element concerned,
   * for files that are damaged or hold something else. Memory is only reserved
   * for what the file is large enough to contain.
   *
   * Format: "VTK XML Formats" in VTK's documentation.
   */
  class VtuFile
  {
  public:
    explicit VtuFile(const std::string &file);

    /** The document refers to the text next to it. */
    VtuFile(const VtuFile &) = delete;
    VtuFile &
    operator=(const VtuFile &)
      = delete;

    std::size_t
    n_points() const
    {
      return size_attribute("NumberOfPoints");
    }
    std::size_t
    n_cells() const
    {
      return size_attribute("NumberOfCells");
    }

    /** Names of the arrays in PointData, CellData, Cells or FieldData. */
    std::vector<std::string>
    names(const std::string &section) const;

    /** The array of a section with this name; it must exist. */
    pugi::xml_node
    array(const std::string &section, const std::string &name) const;

    /** The array of coordinates, three a point, whatever its name. */
    pugi::xml_node
    coordinates() const;

    /** All numbers of @p array.
     * @param n how many there must be; 0: any number. */
    std::vector<double>
    numbers(pugi::xml_node array, std::size_t n = 0) const;
    std::vector<std::int64_t>
    integers(pugi::xml_node array, std::size_t n = 0) const;

    static bool
    is_text(pugi::xml_node array);
    /** The first string of a string array. */
    std::string
    text(pugi::xml_node array) const;

    static std::size_t
    n_components(pugi::xml_node array)
    {
      return array.attribute("NumberOfComponents").as_ullong(1);
    }

    /** Throws "'file', line 12: message". The element may be none. */
    [[noreturn]] void
    fail(pugi::xml_node where, const std::string &message) const;

  private:
    std::string
    line_of(std::ptrdiff_t offset) const;
    void
    find_appended(std::size_t begin);
    void
    parse_document();
    void
    read_attributes();
    void
    find_piece();
    std::size_t
    size_attribute(const char *name) const;
    pugi::xml_node
    section(const std::string &name) const;
    /** How many numbers an array can have at most by what else the file says. */
    std::uint64_t
    most_numbers(pugi::xml_node array) const;
    /** @param most bytes that there may be. */
    std::vector<unsigned char>
    bytes(pugi::xml_node array, std::uint64_t most) const;
    template <typename T>
    std::vector<T>
    values(pugi::xml_node array, std::size_t n) const;
    template <typename T>
    std::vector<T>
    text_values(pugi::xml_node array) const;

    std::string        file;
    std::string        content;
    std::string        xml; ///< content without the appended data
    pugi::xml_document document;
    pugi::xml_node     grid, piece;
    std::string_view   appended; ///< behind the underscore, to the end of the file
    bool               appended_base64 = false;
    BinaryLayout       layout;
  };
} // namespace tetradapt::io

#endif
