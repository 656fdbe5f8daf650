// SPDX-License-Identifier: AGPL-3.0-or-later
#include "surface_headers.h"

#include "tetradapt/core/exceptions.h"

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <vector>

namespace tetradapt::geometry
{
  namespace
  {
    using core::InputError;

    constexpr unsigned int longest_header = 1000; ///< lines

    [[noreturn]] void
    refuse(const std::string &file, unsigned int line, const std::string &problem)
    {
      throw InputError("The surface file '" + file + "', line " + std::to_string(line) + ": "
                       + problem);
    }

    /** A whole number that a file of this size can hold as many points as. */
    void
    check_count(const std::string &file, unsigned int line, const std::string &word)
    {
      char        *end   = nullptr;
      const double count = std::strtod(word.c_str(), &end);
      if (end == word.c_str() || *end != '\0' || !(count >= 0.))
        refuse(file, line, "'" + word + "' is not a number of points or polygons.");
      // No point or polygon takes less than three bytes.
      if (count > static_cast<double>(std::filesystem::file_size(file)) / 3. + 1.)
        refuse(file,
               line,
               word + " points or polygons are announced, more than a file of its size can hold.");
    }

    std::vector<std::string>
    split(const std::string &line)
    {
      std::istringstream       stream(line);
      std::vector<std::string> words;
      for (std::string word; stream >> word;)
        words.push_back(word);
      return words;
    }

    bool
    is_ply_type(const std::string &word)
    {
      static const std::set<std::string> types = {"char",
                                                  "uchar",
                                                  "short",
                                                  "ushort",
                                                  "int",
                                                  "uint",
                                                  "float",
                                                  "double",
                                                  "int8",
                                                  "uint8",
                                                  "int16",
                                                  "uint16",
                                                  "int32",
                                                  "uint32",
                                                  "float32",
                                                  "float64"};
      return types.count(word) > 0;
    }

    /** What a .ply header has declared so far. */
    struct PlyHeader
    {
      std::string           element; ///< the one that properties belong to
      std::set<std::string> coordinates;
      bool                  has_format = false, has_points = false, has_corners = false;
    };

    void
    read_ply_line(PlyHeader                      &header,
                  const std::vector<std::string> &words,
                  const std::string              &file,
                  unsigned int                    line)
    {
      const std::string &key = words[0];
      if (key == "comment" || key == "obj_info")
        return;
      if (key == "format" && words.size() == 3
          && (words[1] == "ascii" || words[1] == "binary_little_endian"
              || words[1] == "binary_big_endian"))
        header.has_format = true;
      else if (key == "element" && words.size() == 3)
        {
          check_count(file, line, words[2]);
          header.element    = words[1];
          header.has_points = header.has_points || words[1] == "vertex";
        }
      else if (key == "property" && words.size() == 3 && is_ply_type(words[1])
               && !header.element.empty())
        {
          if (header.element == "vertex")
            header.coordinates.insert(words[2]);
        }
      else if (key == "property" && words.size() == 5 && words[1] == "list" && is_ply_type(words[2])
               && is_ply_type(words[3]) && !header.element.empty())
        header.has_corners = header.has_corners
                             || (header.element == "face"
                                 && (words[4] == "vertex_indices" || words[4] == "vertex_index"));
      else
        refuse(file, line, "not a valid line of a .ply header.");
    }
  } // namespace

  void
  check_off_header(const std::string &file)
  {
    std::ifstream stream(file, std::ios::binary);
    std::string   line;
    unsigned int  n_numbers = 0;
    for (unsigned int n = 1; n_numbers < 2 && n < longest_header && std::getline(stream, line); ++n)
      for (const std::string &word : split(line.substr(0, line.find('#'))))
        if (n_numbers < 2 && std::isalpha(static_cast<unsigned char>(word[0])) == 0)
          {
            check_count(file, n, word);
            ++n_numbers;
          }
  }

  void
  check_ply_header(const std::string &file)
  {
    std::ifstream stream(file, std::ios::binary);
    std::string   line;
    PlyHeader     header;
    for (unsigned int n = 1; n < longest_header && std::getline(stream, line); ++n)
      {
        const auto words = split(line);
        if (n == 1)
          {
            if (words.size() != 1 || words[0] != "ply")
              refuse(file, n, "a .ply file begins with the line 'ply'.");
            continue;
          }
        if (words.empty())
          refuse(file, n, "not a valid line of a .ply header.");
        if (words[0] != "end_header")
          {
            read_ply_line(header, words, file, n);
            continue;
          }
        if (!header.has_format || !header.has_points || !header.has_corners
            || header.coordinates.count("x") + header.coordinates.count("y")
                   + header.coordinates.count("z")
                 != 3)
          refuse(file,
                 n,
                 "the header does not declare a format, points with x, y and z and faces with "
                 "vertex_indices.");
        return;
      }
    throw InputError("The surface file '" + file + "' has no line 'end_header'.");
  }
} // namespace tetradapt::geometry
