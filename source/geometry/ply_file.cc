// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/exceptions.h"

#include "surface_file.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

namespace tetradapt::geometry
{
  namespace
  {
    constexpr unsigned int longest_header = 1000; ///< lines

    struct PlyType
    {
      unsigned int size; ///< bytes
      bool         whole, is_signed;
    };

    /** The type that a header calls @p word; null if there is none. */
    const PlyType *
    ply_type(const std::string &word)
    {
      static const std::map<std::string, PlyType> types{{"char", {1, true, true}},
                                                        {"int8", {1, true, true}},
                                                        {"uchar", {1, true, false}},
                                                        {"uint8", {1, true, false}},
                                                        {"short", {2, true, true}},
                                                        {"int16", {2, true, true}},
                                                        {"ushort", {2, true, false}},
                                                        {"uint16", {2, true, false}},
                                                        {"int", {4, true, true}},
                                                        {"int32", {4, true, true}},
                                                        {"uint", {4, true, false}},
                                                        {"uint32", {4, true, false}},
                                                        {"float", {4, false, true}},
                                                        {"float32", {4, false, true}},
                                                        {"double", {8, false, true}},
                                                        {"float64", {8, false, true}}};
      const auto                                  found = types.find(word);
      return found == types.end() ? nullptr : &found->second;
    }

    struct PlyProperty
    {
      std::string    name;
      const PlyType *type   = nullptr; ///< of the value, or of the entries of a list
      const PlyType *length = nullptr; ///< of a list's length; null: no list
      unsigned int   line   = 0;

      bool
      is_corners() const
      {
        return length != nullptr && (name == "vertex_indices" || name == "vertex_index");
      }
    };

    struct PlyElement
    {
      std::string              name;
      unsigned long            count = 0;
      std::vector<PlyProperty> properties;
    };

    bool
    is_coordinate(const PlyElement &element, const std::string &property)
    {
      return element.name == "vertex" && property.size() == 1 && property.find_first_of("xyz") == 0;
    }

    /** A .ply file in memory, with its header read. */
    class PlyFile
    {
    public:
      explicit PlyFile(const std::string &file) : file(file)
      {
        std::ifstream stream(file, std::ios::binary);
        contents.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
        read_header();
        check_header();
      }

      /** Checks the data; @return the contents for CGAL. */
      std::string
      checked()
      {
        if (format == "ascii")
          {
            check_text();
            return header_for_cgal() + contents.substr(data_begin);
          }
        check_binary();
        return std::move(contents);
      }

    private:
      void
      read_header()
      {
        std::size_t begin = 0;
        while (n_lines < longest_header)
          {
            const std::size_t end = contents.find('\n', begin);
            if (end == std::string::npos)
              break;
            ++n_lines;
            const std::string line  = contents.substr(begin, end - begin);
            const auto        words = words_of(line);
            begin                   = end + 1;
            header.push_back(words);
            if (n_lines == 1 && (words.size() != 1 || words[0] != "ply"))
              refuse_line(file, n_lines, "a .ply file begins with the line 'ply'.");
            if (words.empty())
              refuse_line(file, n_lines, "not a valid line of a .ply header.");
            if (words[0] == "end_header")
              {
                data_begin = begin;
                return;
              }
            if (n_lines > 1)
              read_header_line(words);
          }
        throw core::InputError("The surface file '" + file + "' has no line 'end_header'.");
      }

      void
      read_header_line(const std::vector<std::string> &words)
      {
        const std::string &key = words[0];
        if (key == "comment" || key == "obj_info")
          return;
        if (key == "format" && words.size() == 3
            && (words[1] == "ascii" || words[1] == "binary_little_endian"
                || words[1] == "binary_big_endian"))
          format = words[1];
        else if (key == "element" && words.size() == 3)
          elements.push_back(
            {words[1], announced_count(file, n_lines, words[2], contents.size()), {}});
        else if (key == "property" && words.size() == 3 && ply_type(words[1]) != nullptr
                 && !elements.empty())
          elements.back().properties.push_back({words[2], ply_type(words[1]), nullptr, n_lines});
        else if (key == "property" && words.size() == 5 && words[1] == "list"
                 && ply_type(words[2]) != nullptr && ply_type(words[3]) != nullptr
                 && !elements.empty())
          elements.back().properties.push_back(
            {words[4], ply_type(words[3]), ply_type(words[2]), n_lines});
        else
          refuse_line(file, n_lines, "not a valid line of a .ply header.");
      }

      const PlyElement *
      element(const std::string &name) const
      {
        const auto found = std::find_if(elements.begin(), elements.end(), [&](const auto &e) {
          return e.name == name;
        });
        return found == elements.end() ? nullptr : &*found;
      }

      void
      check_header() const
      {
        const PlyElement *points = element("vertex"), *faces = element("face");
        const auto        n_of = [](const PlyElement *e, const auto &is_wanted) {
          return e == nullptr
                          ? 0
                          : std::count_if(e->properties.begin(), e->properties.end(), is_wanted);
        };
        if (format.empty()
            || n_of(points,
                    [&](const PlyProperty &p) {
                      return p.length == nullptr && is_coordinate(*points, p.name);
                    })
                 != 3
            || n_of(faces, [](const PlyProperty &p) { return p.is_corners(); }) != 1)
          refuse_line(file,
                      n_lines,
                      "the header does not declare a format, points with x, y and z and faces "
                      "with vertex_indices.");
        for (const PlyElement &e : elements)
          for (const PlyProperty &p : e.properties)
            check_types(e, p);
      }

      /** CGAL's reader crashes on whole-number coordinates, and takes no point numbers
       * but those of four bytes. In text files the header can be changed. */
      void
      check_types(const PlyElement &e, const PlyProperty &p) const
      {
        if (p.length != nullptr && !p.length->whole)
          refuse_line(file, p.line, "the length of a list is not of a whole-number type.");
        if (p.is_corners() && !p.type->whole)
          refuse_line(file, p.line, "point numbers are not of a whole-number type.");
        if (format == "ascii")
          return;
        if (is_coordinate(e, p.name) && p.type->whole)
          refuse_line(file,
                      p.line,
                      "coordinates of a whole-number type are read from text files only. Write "
                      "them as float or double.");
        if (p.is_corners() && p.type->size != 4)
          refuse_line(file,
                      p.line,
                      "point numbers of this type are read from text files only. Write them as "
                      "int or uint.");
      }

      /** One line an element, as the format has it. */
      void
      check_text() const
      {
        std::istringstream stream(contents.substr(data_begin));
        unsigned int       line_number = n_lines;
        for (const PlyElement &e : elements)
          for (unsigned long i = 0; i < e.count; ++i)
            {
              std::vector<std::string> words;
              for (std::string line; words.empty();)
                {
                  if (!std::getline(stream, line))
                    refuse_line(file,
                                line_number,
                                "the file ends before " + e.name + " " + std::to_string(i) + ".");
                  ++line_number;
                  words = words_of(line);
                }
              check_text_line(e, words, line_number);
            }
      }

      void
      check_text_line(const PlyElement               &e,
                      const std::vector<std::string> &words,
                      const unsigned int              line_number) const
      {
        std::size_t next = 0;
        const auto  take = [&]() -> const std::string  &{
          if (next == words.size())
            refuse_line(file, line_number, "numbers are missing in this line of a " + e.name + ".");
          return words[next++];
        };
        for (const PlyProperty &p : e.properties)
          {
            double n = 1.;
            if (p.length != nullptr)
              n = number_of(file, line_number, take());
            if (!(n >= 0. && n <= static_cast<double>(words.size())))
              refuse_line(file, line_number, "the length of a list does not fit the line.");
            for (unsigned long i = 0; i < static_cast<unsigned long>(n); ++i)
              if (p.is_corners() && e.name == "face")
                point_of(file, line_number, take(), element("vertex")->count);
              else
                number_of(file, line_number, take());
          }
        if (next != words.size())
          refuse_line(file, line_number, "this line of a " + e.name + " has too many numbers.");
      }

      /** A whole number of the data. */
      std::int64_t
      whole_number(const std::size_t place, const PlyType &type) const
      {
        std::uint64_t value = 0;
        for (unsigned int i = 0; i < type.size; ++i)
          {
            const unsigned int from = format == "binary_big_endian" ? type.size - 1 - i : i;
            value |= std::uint64_t(static_cast<unsigned char>(contents[place + from])) << (8 * i);
          }
        const std::uint64_t sign = std::uint64_t(1) << (8 * type.size - 1);
        if (type.is_signed && (value & sign) != 0)
          return static_cast<std::int64_t>(value) - static_cast<std::int64_t>(2 * sign);
        return static_cast<std::int64_t>(value);
      }

      void
      check_binary() const
      {
        std::size_t place = data_begin;
        for (const PlyElement &e : elements)
          for (unsigned long i = 0; i < e.count; ++i)
            {
              const auto where = [&]() { return e.name + " " + std::to_string(i); };
              const auto need  = [&](const std::size_t n_bytes) {
                if (n_bytes > contents.size() - place)
                  throw core::InputError("The surface file '" + file + "' ends before the end of "
                                         + where() + " (counted from 0).");
              };
              for (const PlyProperty &p : e.properties)
                {
                  std::int64_t n = 1;
                  if (p.length != nullptr)
                    {
                      need(p.length->size);
                      n = whole_number(place, *p.length);
                      place += p.length->size;
                    }
                  if (n < 0 || static_cast<std::uint64_t>(n) > contents.size())
                    throw core::InputError("The surface file '" + file + "': " + where()
                                           + " (counted from 0) has a list that does not fit "
                                             "into the file.");
                  need(n * p.type->size);
                  if (p.is_corners() && e.name == "face")
                    check_corners(place, n, *p.type, where());
                  place += n * p.type->size;
                }
            }
      }

      void
      check_corners(const std::size_t  place,
                    const std::int64_t n,
                    const PlyType     &type,
                    const std::string &where) const
      {
        for (std::int64_t i = 0; i < n; ++i)
          {
            const std::int64_t point = whole_number(place + i * type.size, type);
            if (point < 0 || static_cast<unsigned long>(point) >= element("vertex")->count)
              throw core::InputError("The surface file '" + file + "': " + where
                                     + " (counted from 0) names point " + std::to_string(point)
                                     + "; there are " + std::to_string(element("vertex")->count)
                                     + ", counted from 0.");
          }
      }

      std::string
      header_for_cgal() const
      {
        std::string       text, current;
        const std::string real = "double", whole = "int";
        for (auto words : header)
          {
            if (words[0] == "comment" || words[0] == "obj_info")
              continue;
            if (words[0] == "element")
              current = words[1];
            if (words[0] == "property" && words.size() == 3
                && is_coordinate({current, 0, {}}, words[2]) && ply_type(words[1])->whole)
              words[1] = real;
            if (words[0] == "property" && words.size() == 5 && ply_type(words[3])->whole)
              words[3] = whole;
            for (std::size_t i = 0; i < words.size(); ++i)
              text += (i > 0 ? " " : "") + words[i];
            text += '\n';
          }
        return text;
      }

      std::string                           file, contents, format;
      std::vector<std::vector<std::string>> header; ///< words of its lines
      std::vector<PlyElement>               elements;
      std::size_t                           data_begin = 0;
      unsigned int                          n_lines    = 0;
    };
  } // namespace

  std::string
  checked_ply(const std::string &file)
  {
    return PlyFile(file).checked();
  }
} // namespace tetradapt::geometry
