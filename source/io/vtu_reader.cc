// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/vtu_reader.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/io/file_scanner.h"
#include "tetradapt/io/vtk_grid.h"
#include "tetradapt/io/vtu_file.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetradapt::io
{
  using dealii::Tensor;

  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;



    VtkGrid
    read_grid(const VtuFile &file)
    {
      VtkGrid           grid;
      const std::size_t n_points = file.n_points();
      const std::size_t n_cells  = file.n_cells();
      // Sizes that no array of this file can have are refused when it is read.
      if (n_points == 0 || n_points > std::numeric_limits<unsigned int>::max())
        file.fail(file.coordinates(), "the grid has " + std::to_string(n_points) + " points.");
      const auto x = file.numbers(file.coordinates(), 3 * n_points);
      grid.points.resize(n_points);
      for (std::size_t i = 0; i < n_points; ++i)
        grid.points[i] = Point<3>(x[3 * i], x[3 * i + 1], x[3 * i + 2]);

      grid.types                    = file.integers(file.array("Cells", "types"), n_cells);
      grid.ends                     = file.integers(file.array("Cells", "offsets"), n_cells);
      grid.connectivity             = file.integers(file.array("Cells", "connectivity"));
      const auto [region, boundary] = id_arrays(file.names("CellData"));
      if (!region.empty())
        grid.regions = file.numbers(file.array("CellData", region), n_cells);
      if (!boundary.empty())
        grid.boundary_ids = file.numbers(file.array("CellData", boundary), n_cells);
      return grid;
    }



    bool
    has(const std::vector<std::string> &names, const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }



    /** Calls @p use (id, name) for every line "7 left hand". */
    template <typename Use>
    void
    read_names(const VtuFile &file, const std::string &array, const Use &use)
    {
      const std::string text = file.text(file.array("FieldData", array));
      std::string_view  rest(text);
      while (!rest.empty())
        {
          const std::size_t      n     = std::min(rest.find('\n'), rest.size());
          const std::string_view line  = rest.substr(0, n);
          const std::size_t      space = std::min(line.find(' '), line.size());
          std::int64_t           id;
          if (!parse(line.substr(0, space), id))
            file.fail(file.array("FieldData", array), excerpt(line) + " has no number.");
          use(static_cast<int>(id), std::string(line.substr(std::min(space + 1, line.size()))));
          rest.remove_prefix(std::min(n + 1, rest.size()));
        }
    }



    /** Boundary faces and names that this program wrote; numbers of points as in
     * the file. */
    void
    read_own_data(const VtuFile &file, mesh::TetMesh &mesh)
    {
      const std::vector<std::string> names = file.names("FieldData");
      if (has(names, "region_names"))
        read_names(file, "region_names", [&](const int id, const std::string &name) {
          mesh.region_names[id] = name;
        });
      if (!has(names, "boundary_faces") || !has(names, "boundary_ids"))
        return;

      const auto                  ids   = file.integers(file.array("FieldData", "boundary_ids"));
      const auto                  array = file.array("FieldData", "boundary_faces");
      const auto                  faces = file.integers(array, 3 * ids.size());
      std::map<int, unsigned int> patch_of_id;
      mesh.faces.clear();
      mesh.patches.clear();
      for (std::size_t f = 0; f < ids.size(); ++f)
        {
          const auto entry = patch_of_id.emplace(ids[f], mesh.patches.size());
          if (entry.second)
            {
              mesh.patches.emplace_back();
              mesh.patches.back().boundary_id = ids[f];
            }
          mesh::BoundaryFace face;
          for (unsigned int i = 0; i < 3; ++i)
            {
              const std::int64_t v = faces[3 * f + i];
              if (v < 0 || v >= mesh.n_points())
                file.fail(array,
                          "it names point " + std::to_string(v) + ", but there are "
                            + std::to_string(mesh.n_points()) + ".");
              face.vertices[i] = v;
            }
          face.patch = entry.first->second;
          mesh.faces.push_back(face);
        }
      if (has(names, "boundary_names"))
        read_names(file, "boundary_names", [&](const int id, const std::string &name) {
          if (const auto patch = patch_of_id.find(id); patch != patch_of_id.end())
            mesh.patches[patch->second].name = name;
        });
    }



    MeshBuilder::Fail
    fail_function(const VtuFile &file)
    {
      return [&file](const std::string &message) { file.fail({}, message); };
    }



    /** The number that each used point gets when the others are left out. */
    std::vector<unsigned int>
    numbers_of_used_points(const mesh::TetMesh &mesh)
    {
      std::vector<unsigned int> number(mesh.n_points(), none);
      for (const auto &cell : mesh.cells)
        for (const unsigned int v : cell)
          number[v] = 0;
      unsigned int n_used = 0;
      for (unsigned int &n : number)
        if (n != none)
          n = n_used++;
      return number;
    }



    /**
     * Copies the displacements of the nodes in the middle of edges from the file's
     * numbering.
     * @param nodes connectivity of the file, ten nodes a cell.
     * @param number of the corners, from the file's to those of the mesh.
     */
    void
    copy_edge_values(const VtuFile                   &file,
                     const std::vector<std::int64_t> &nodes,
                     const std::vector<unsigned int> &number,
                     const std::vector<double>       &u,
                     mesh::NodalField                &field)
    {
      const mesh::TetMesh      &mesh = field.mesh();
      std::vector<std::int64_t> source(field.edges().edges.size(), -1);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int e = 0; e < 6; ++e)
          {
            // finalize() may have exchanged corners of the cell.
            const std::int64_t *local = nodes.data() + 10 * static_cast<std::size_t>(c);
            const unsigned int  a     = number[local[mesh::edge_vertices[e][0]]];
            const unsigned int  b     = number[local[mesh::edge_vertices[e][1]]];
            unsigned int        edge  = none;
            for (const unsigned int candidate : field.edges().cell_edges[c])
              if (field.edges().edges[candidate]
                  == std::array<unsigned int, 2>{{std::min(a, b), std::max(a, b)}})
                edge = candidate;

            const std::int64_t node  = local[4 + e];
            Tensor<1, 3>      &value = field.values[mesh.n_points() + edge];
            for (unsigned int d = 0; d < 3; ++d)
              {
                if (source[edge] >= 0 && u[3 * node + d] != value[d])
                  file.fail(file.array("PointData", "displacement"),
                            "nodes " + std::to_string(node) + " and " + std::to_string(source[edge])
                              + " lie on the same edge but move differently.");
                value[d] = u[3 * node + d];
              }
            source[edge] = node;
          }
    }
  } // namespace



  mesh::TetMesh
  read_vtu(const std::string &name)
  {
    const VtuFile file(name);
    mesh::TetMesh mesh = mesh_of_grid(read_grid(file), fail_function(file));
    read_own_data(file, mesh);
    return mesh;
  }



  DisplacementFile
  read_displacement_vtu(const std::string &name)
  {
    const VtuFile      file(name);
    VtkGrid            grid   = read_grid(file);
    const unsigned int degree = grid.types[0] == vtk_quadratic_tetra ? 2 : 1;
    for (std::size_t c = 0; c < grid.types.size(); ++c)
      if (grid.types[c] != (degree == 2 ? vtk_quadratic_tetra : vtk_tetra))
        file.fail(file.array("Cells", "types"),
                  "cell " + std::to_string(c) + " (counted from 0) has the VTK type "
                    + std::to_string(grid.types[c])
                    + "; all cells must be tetrahedra of the same order (10 or 24).");

    const auto array = file.array("PointData", "displacement");
    if (VtuFile::n_components(array) != 3)
      file.fail(array, "it must have three components.");
    const auto u = file.numbers(array, 3 * file.n_points());
    for (const double value : u)
      if (!std::isfinite(value))
        file.fail(array, "it holds a value that is not finite.");

    const std::vector<std::int64_t> nodes = grid.connectivity;
    auto mesh = std::make_shared<mesh::TetMesh>(mesh_of_grid(std::move(grid), fail_function(file)));
    read_own_data(file, *mesh);
    const std::vector<unsigned int> number = numbers_of_used_points(*mesh);
    mesh::finalize(*mesh, "'" + name + "'");

    DisplacementFile result;
    result.displacement = std::make_shared<mesh::NodalField>(mesh, degree);
    for (std::size_t v = 0; v < number.size(); ++v)
      if (number[v] != none)
        for (unsigned int d = 0; d < 3; ++d)
          result.displacement->values[number[v]][d] = u[3 * v + d];
    if (degree == 2)
      copy_edge_values(file, nodes, number, u, *result.displacement);

    for (const std::string &field_name : file.names("FieldData"))
      {
        const auto field_array = file.array("FieldData", field_name);
        if (VtuFile::is_text(field_array))
          result.texts[field_name] = file.text(field_array);
        else if (const auto values = file.numbers(field_array); values.size() == 1)
          result.values[field_name] = values[0];
      }
    return result;
  }
} // namespace tetradapt::io
