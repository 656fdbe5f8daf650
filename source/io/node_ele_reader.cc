// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/node_ele_reader.h"

#include "tetradapt/io/file_scanner.h"
#include "tetradapt/io/mesh_builder.h"

#include <cmath>
#include <filesystem>
#include <limits>

namespace tetradapt::io
{
  namespace
  {
    constexpr std::int64_t max_int = std::numeric_limits<int>::max();

    /** Where TetGen puts the node in the middle of each edge of edge_vertices:
     * its order is (23)(03)(01)(12)(13)(02). */
    constexpr std::array<unsigned int, 6> middle_nodes{{6, 7, 9, 5, 8, 4}};



    /** One of the files: lines of numbers, with comments behind '#'. */
    class Rows
    {
    public:
      explicit Rows(const std::string &file) : scanner(file)
      {
        scanner.set_comment('#');
      }

      /** Goes to the next line that says something. */
      void
      next(const char *what)
      {
        std::string_view text;
        if (!scanner.next_line(text))
          scanner.fail(std::string("the file ends where ") + what + " should follow.");
        words.clear();
        current = 0;
        while (!text.empty())
          {
            const std::size_t n = std::min(text.find_first_of(" \t,"), text.size());
            if (n > 0)
              words.push_back(text.substr(0, n));
            text.remove_prefix(std::min(n + 1, text.size()));
          }
      }

      std::size_t
      n_words() const
      {
        return words.size();
      }

      double
      number(const char *what)
      {
        if (current >= words.size())
          scanner.fail(std::string("the line ends where ") + what + " should follow.");
        double value;
        if (!parse(words[current], value))
          scanner.fail(excerpt(words[current]) + " stands where " + what
                       + ", a finite number, is expected.");
        ++current;
        return value;
      }

      std::int64_t
      integer(const char *what, const std::int64_t smallest = -max_int)
      {
        const double value = number(what);
        if (value != std::floor(value) || value < smallest || value > max_int)
          scanner.fail(excerpt(words[current - 1]) + " stands where " + what + ", a whole number"
                       + (smallest >= 0 ? " from " + std::to_string(smallest) : "")
                       + ", is expected.");
        return value;
      }

      /** The number of rows that follow. */
      std::size_t
      count(const char *what)
      {
        const std::size_t n = integer(what, 0);
        scanner.check_count(n, what, 4);
        return n;
      }

      void
      skip(const std::size_t n)
      {
        current += n;
      }

      FileScanner scanner;

    private:
      std::vector<std::string_view> words;
      std::size_t                   current = 0;
    };



    /** Reads the points. @return the number of the first one, 0 or 1. */
    std::int64_t
    read_points(const std::string &file, std::vector<Point<3>> &points)
    {
      Rows rows(file);
      rows.next("the number of points");
      const std::size_t n = rows.count("the number of points");
      if (rows.n_words() > 1 && rows.integer("the dimension") != 3)
        rows.scanner.fail("the points must have three coordinates.");
      if (n == 0)
        rows.scanner.fail("the file has no points.");

      std::int64_t first = 0;
      points.reserve(n);
      for (std::size_t i = 0; i < n; ++i)
        {
          rows.next("a point");
          const std::int64_t number = rows.integer("a point's number", 0);
          if (i == 0)
            first = number;
          if (first > 1 || number != first + static_cast<std::int64_t>(i))
            rows.scanner.fail("the point has the number " + std::to_string(number)
                              + "; points must be numbered from 0 or 1, one after the other.");
          Point<3> point;
          for (unsigned int d = 0; d < 3; ++d)
            point[d] = rows.number("a coordinate");
          points.push_back(point);
        }
      return first;
    }



    void
    read_cells(const std::string &file, const std::int64_t first, MeshBuilder &builder, Rows &rows)
    {
      rows.next("the number of tetrahedra");
      const std::size_t n = rows.count("the number of tetrahedra");
      const auto n_nodes  = rows.n_words() > 1 ? rows.integer("the nodes of a tetrahedron") : 4;
      const auto n_values = rows.n_words() > 2 ? rows.integer("the number of attributes", 0) : 0;
      if (n_nodes != 4 && n_nodes != 10)
        rows.scanner.fail("tetrahedra with " + std::to_string(n_nodes)
                          + " nodes; they must have 4 or 10.");
      for (std::size_t i = 0; i < n; ++i)
        {
          rows.next("a tetrahedron");
          rows.integer("the number of a tetrahedron");
          std::array<unsigned int, 10> nodes{};
          for (unsigned int k = 0; k < n_nodes; ++k)
            nodes[k] = rows.integer("a point's number", first) - first;
          const int region = n_values > 0 ? rows.integer("the region") : 0;
          if (n_nodes == 4)
            builder.add_cell({{nodes[0], nodes[1], nodes[2], nodes[3]}}, region);
          else
            {
              std::array<unsigned int, 10> ordered = nodes;
              for (unsigned int e = 0; e < 6; ++e)
                ordered[4 + e] = nodes[middle_nodes[e]];
              builder.add_quadratic_cell(ordered, region);
            }
        }
      if (n == 0)
        rows.scanner.fail("'" + file + "' has no tetrahedra.");
    }



    void
    read_faces(const std::int64_t first, MeshBuilder &builder, Rows &rows)
    {
      rows.next("the number of faces");
      const std::size_t n   = rows.count("the number of faces");
      const bool has_marker = rows.n_words() > 1 && rows.integer("the number of markers") > 0;
      for (std::size_t i = 0; i < n; ++i)
        {
          rows.next("a face");
          rows.integer("the number of a face");
          std::array<unsigned int, 3> vertices;
          for (unsigned int &v : vertices)
            v = rows.integer("a point's number", first) - first;
          // With -o2 three nodes in the middle of edges precede the marker.
          if (rows.n_words() >= 7u + has_marker)
            rows.skip(3);
          builder.add_face(vertices, has_marker ? rows.integer("the face's marker") : 0);
        }
    }
  } // namespace



  mesh::TetMesh
  read_node_ele(const std::string &file)
  {
    const auto name_with = [&](const char *ending) {
      return std::filesystem::path(file).replace_extension(ending).string();
    };
    std::vector<Point<3>> points;
    const std::int64_t    first = read_points(name_with(".node"), points);

    // Errors in the connectivity are to be told with the line of the file being read.
    Rows       *rows = nullptr;
    MeshBuilder builder([&](const std::string &message) { rows->scanner.fail(message); });
    builder.points() = std::move(points);

    const std::string cell_file = name_with(".ele");
    Rows              cell_rows(cell_file);
    rows = &cell_rows;
    read_cells(cell_file, first, builder, cell_rows);

    const std::string face_file = name_with(".face");
    if (std::filesystem::exists(face_file))
      {
        Rows face_rows(face_file);
        rows = &face_rows;
        read_faces(first, builder, face_rows);
      }
    return builder.take();
  }
} // namespace tetradapt::io
