// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/vtk_reader.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/io/vtk_grid.h"
#include "tetradapt/io/vtk_scanner.h"

namespace tetradapt::io
{
  namespace
  {
    class VtkReader
    {
    public:
      explicit VtkReader(const std::string &file) : scanner(file)
      {
      }

      mesh::TetMesh
      read();

    private:
      void
      read_header();
      bool
      read_keyword();
      bool
      read_geometry(const std::string &keyword);
      void
      read_cells();
      void
      read_attribute(const std::string &keyword);
      void
      read_field();
      void
      keep(const std::string &name, std::size_t n_components, std::vector<double> &&array)
      {
        if (in_cell_data && n_components == 1)
          cell_arrays[name] = std::move(array);
      }

      VtkScanner                                 scanner;
      bool                                       version_5    = false;
      bool                                       in_cell_data = false;
      std::size_t                                n_data       = 0; ///< of CELL_DATA or POINT_DATA
      VtkGrid                                    grid;
      bool                                       has_points = false, has_cells = false;
      std::map<std::string, std::vector<double>> cell_arrays;
    };



    void
    VtkReader::read_header()
    {
      const std::string first(trimmed(scanner.line()));
      const std::string start = "# vtk DataFile Version ";
      double            version;
      if (first.compare(0, start.size(), start) != 0 || !parse(first.substr(start.size()), version))
        scanner.fail(excerpt(first) + " stands where '# vtk DataFile Version ...' is expected.");
      version_5 = version >= 5.;
      scanner.line(); // the title

      std::string_view text;
      if (!scanner.next_line(text))
        scanner.fail("the file ends before ASCII or BINARY.");
      const std::string encoding = lower_case(text);
      if (encoding != "ascii" && encoding != "binary")
        scanner.fail(excerpt(text) + " stands where ASCII or BINARY is expected.");
      scanner.set_binary_arrays(encoding == "binary");

      if (!scanner.next_line(text) || lower_case(text.substr(0, 7)) != "dataset")
        scanner.fail("the line DATASET UNSTRUCTURED_GRID is missing.");
      if (lower_case(trimmed(text.substr(7))) != "unstructured_grid")
        scanner.fail("the data set is of kind " + excerpt(trimmed(text.substr(7)))
                     + "; only UNSTRUCTURED_GRID can hold tetrahedra.");
    }



    void
    VtkReader::read_cells()
    {
      const std::size_t n    = scanner.word_count(1, "the number of cells");
      const std::size_t size = scanner.word_count(2, "the size of the list of cells");
      if (version_5)
        {
          for (auto *list : {&grid.ends, &grid.connectivity})
            {
              const bool ends = list == &grid.ends;
              if (!scanner.next_words())
                scanner.fail("the list of cells ends before its OFFSETS and CONNECTIVITY.");
              if (lower_case(scanner.words()[0]) != (ends ? "offsets" : "connectivity"))
                scanner.fail(excerpt(scanner.words()[0]) + " stands where "
                             + (ends ? "OFFSETS" : "CONNECTIVITY") + " is expected.");
              *list = scanner.values<std::int64_t>(ends ? n : size,
                                                   scanner.word_type(1),
                                                   ends ? "a cell's offset" : "a cell's node");
            }
          if (!grid.ends.empty())
            grid.ends.erase(grid.ends.begin()); // the first offset is 0
          return;
        }

      const auto list = scanner.values<std::int64_t>(size, ScalarType::int32, "a cell's node");
      for (std::size_t k = 0; k < list.size() && grid.ends.size() < n;)
        {
          const std::int64_t n_nodes = list[k++];
          if (n_nodes < 0 || n_nodes > static_cast<std::int64_t>(list.size() - k))
            scanner.fail("cell " + std::to_string(grid.ends.size()) + " (counted from 0) has "
                         + std::to_string(n_nodes) + " nodes, more than are left in the list.");
          grid.connectivity.insert(grid.connectivity.end(),
                                   list.begin() + k,
                                   list.begin() + k + n_nodes);
          grid.ends.push_back(grid.connectivity.size());
          k += n_nodes;
        }
      if (grid.ends.size() != n || grid.connectivity.size() + n != list.size())
        scanner.fail("the list of cells holds " + std::to_string(grid.ends.size())
                     + " cells instead of " + std::to_string(n)
                     + ", or more numbers than these need.");
    }



    bool
    VtkReader::read_geometry(const std::string &keyword)
    {
      if (keyword == "points")
        {
          const std::size_t n = scanner.word_count(1, "the number of points");
          scanner.need_words(3);
          // Three letters each at least, and space between them.
          scanner.check_count(n, "the number of points", 3);
          const auto x
            = scanner.values<double>(3 * n, scanner.word_type(2), "a point's coordinate");
          grid.points.resize(n);
          for (std::size_t i = 0; i < n; ++i)
            grid.points[i] = Point<3>(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
          has_points = true;
        }
      else if (keyword == "cells")
        {
          if (has_cells)
            scanner.fail("there is a second list of CELLS.");
          read_cells();
          has_cells = true;
        }
      else if (keyword == "cell_types")
        grid.types = scanner.values<std::int64_t>(scanner.word_count(1, "the number of cells"),
                                                  ScalarType::int32,
                                                  "a cell's type");
      else if (keyword == "cell_data" || keyword == "point_data")
        {
          in_cell_data = keyword == "cell_data";
          n_data       = scanner.word_count(1, "the number of data");
          if (n_data != (in_cell_data ? grid.types.size() : grid.points.size()))
            scanner.fail("the number of data is " + scanner.words()[1] + ", but there are "
                         + std::to_string(in_cell_data ? grid.types.size() : grid.points.size())
                         + (in_cell_data ? " cells." : " points."));
        }
      else
        return false;
      return true;
    }



    void
    VtkReader::read_field()
    {
      const std::size_t n_arrays = scanner.word_count(2, "the number of arrays");
      for (std::size_t a = 0; a < n_arrays;)
        {
          if (!scanner.next_words())
            scanner.fail("the file ends where an array should follow.");
          if (lower_case(scanner.words()[0]) == "metadata")
            {
              scanner.skip_metadata();
              continue;
            }
          scanner.need_words(4);
          const std::size_t n_components = scanner.word_count(1, "the number of components");
          const std::size_t n_tuples     = scanner.word_count(2, "the number of tuples");
          const std::string name         = scanner.words()[0];
          const ScalarType  array_type   = scanner.word_type(3);
          if (n_components > 0)
            scanner.check_count(n_tuples, "the number of tuples", n_components);
          auto array = scanner.values<double>(n_components * n_tuples, array_type, "a value");
          if (n_tuples == n_data)
            keep(name, n_components, std::move(array));
          ++a;
        }
    }



    void
    VtkReader::read_attribute(const std::string &keyword)
    {
      static const std::map<std::string, std::size_t> sizes{{"vectors", 3},
                                                            {"normals", 3},
                                                            {"tensors", 9},
                                                            {"tensors6", 6},
                                                            {"global_ids", 1},
                                                            {"pedigree_ids", 1}};
      const auto read = [&](const std::size_t n_components, const ScalarType type) {
        if (n_components > 100)
          scanner.fail("an array with " + std::to_string(n_components) + " components.");
        return scanner.values<double>(n_components * n_data, type, "a value");
      };

      if (keyword == "scalars")
        {
          const ScalarType  type = scanner.word_type(2);
          const std::string name = scanner.words()[1];
          const std::size_t n_components
            = scanner.words().size() > 3 ? scanner.word_count(3, "the number of components") : 1;
          scanner.expect("LOOKUP_TABLE");
          scanner.line();
          keep(name, n_components, read(n_components, type));
        }
      else if (keyword == "lookup_table")
        {
          const std::size_t n = scanner.word_count(2, "the size of the table");
          scanner.values<double>(4 * n, ScalarType::uint8, "a colour");
        }
      else if (keyword == "color_scalars")
        read(scanner.word_count(2, "the number of components"), ScalarType::uint8);
      else if (keyword == "texture_coordinates")
        read(scanner.word_count(2, "the number of components"), scanner.word_type(3));
      else if (const auto size = sizes.find(keyword); size != sizes.end())
        read(size->second, scanner.word_type(2));
      else
        scanner.fail(excerpt(scanner.words()[0])
                     + " stands where a keyword of the format is expected.");
    }



    bool
    VtkReader::read_keyword()
    {
      if (!scanner.next_words())
        return false;
      const std::string keyword = lower_case(scanner.words()[0]);
      if (keyword == "metadata")
        scanner.skip_metadata();
      else if (keyword == "field")
        read_field();
      else if (!read_geometry(keyword))
        read_attribute(keyword);
      return true;
    }



    mesh::TetMesh
    VtkReader::read()
    {
      read_header();
      while (read_keyword())
        ;
      if (!has_points || !has_cells || grid.types.empty())
        scanner.fail(std::string("the file ends without ")
                     + (!has_points ? "POINTS." : (!has_cells ? "CELLS." : "CELL_TYPES.")));

      std::vector<std::string> names;
      for (const auto &array : cell_arrays)
        names.push_back(array.first);
      const auto [region, boundary] = id_arrays(names);
      if (!region.empty())
        grid.regions = cell_arrays[region];
      if (!boundary.empty())
        grid.boundary_ids = cell_arrays[boundary];
      return mesh_of_grid(std::move(grid), [&](const std::string &message) {
        throw core::InputError("'" + scanner.file() + "': " + message);
      });
    }
  } // namespace



  mesh::TetMesh
  read_vtk(const std::string &file)
  {
    return VtkReader(file).read();
  }
} // namespace tetradapt::io
