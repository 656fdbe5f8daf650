// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/finalize.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;



    std::string
    number_text(const double value, const unsigned int digits)
    {
      std::ostringstream text;
      text.precision(digits);
      text << value;
      return text.str();
    }



    /** Says where a cell is. */
    std::string
    describe_cell(const TetMesh &mesh, const unsigned int cell)
    {
      std::string text = "tetrahedron " + std::to_string(cell) + " with corners ";
      for (unsigned int i = 0; i < 4; ++i)
        text += (i ? ", " : "") + to_string(mesh.points[mesh.cells[cell][i]]);
      return text;
    }



    template <std::size_t n>
    void
    check_indices(const TetMesh                     &mesh,
                  const std::array<unsigned int, n> &vertices,
                  const std::string                 &what,
                  const char                        *kind,
                  const unsigned int                 number)
    {
      const auto subject = [&] { return what + ": " + kind + " " + std::to_string(number); };
      for (unsigned int i = 0; i < n; ++i)
        {
          if (vertices[i] >= mesh.n_points())
            throw core::InputError(subject() + " names point " + std::to_string(vertices[i])
                                   + ", but there are only " + std::to_string(mesh.n_points())
                                   + " points (counted from 0). Correct the connectivity.");
          for (unsigned int j = 0; j < i; ++j)
            if (vertices[i] == vertices[j])
              throw core::InputError(subject() + " names point " + std::to_string(vertices[i]) + " "
                                     + to_string(mesh.points[vertices[i]])
                                     + " twice. Remove it or correct the connectivity.");
        }
    }



    void
    check_sizes(TetMesh &mesh, const std::string &what)
    {
      if (mesh.cells.empty())
        throw core::InputError(what + " has no tetrahedra.");
      // Faces and edges of cells are numbered in 32 bits.
      if (mesh.cells.size() > std::numeric_limits<unsigned int>::max() / 8
          || mesh.points.size() > std::numeric_limits<unsigned int>::max() / 8)
        throw core::InputError(what + " has " + std::to_string(mesh.cells.size())
                               + " tetrahedra, more than can be numbered here.");
      if (mesh.regions.empty())
        mesh.regions.assign(mesh.cells.size(), 0);
      if (mesh.regions.size() != mesh.cells.size())
        throw core::InputError(what + " has " + std::to_string(mesh.cells.size())
                               + " tetrahedra but " + std::to_string(mesh.regions.size())
                               + " region ids.");

      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        check_indices(mesh, mesh.cells[c], what, "tetrahedron", c);
      for (unsigned int f = 0; f < mesh.faces.size(); ++f)
        {
          check_indices(mesh, mesh.faces[f].vertices, what, "boundary triangle", f);
          if (mesh.faces[f].patch >= mesh.patches.size())
            throw core::InputError(what + ": boundary triangle " + std::to_string(f)
                                   + " refers to a patch that does not exist.");
        }
    }



    /** Removes points that no cell names. Returns how many. */
    unsigned int
    remove_unused_points(TetMesh &mesh, const std::string &what)
    {
      std::vector<unsigned int> number(mesh.n_points(), none);
      for (const auto &cell : mesh.cells)
        for (const unsigned int v : cell)
          number[v] = 0;
      unsigned int n_used = 0;
      for (unsigned int v = 0; v < number.size(); ++v)
        if (number[v] != none)
          {
            number[v]           = n_used;
            mesh.points[n_used] = mesh.points[v];
            ++n_used;
          }
      const unsigned int n_removed = mesh.n_points() - n_used;
      if (n_removed == 0)
        return 0;

      for (auto &cell : mesh.cells)
        for (unsigned int &v : cell)
          v = number[v];
      for (unsigned int f = 0; f < mesh.faces.size(); ++f)
        for (unsigned int &v : mesh.faces[f].vertices)
          {
            if (number[v] == none)
              throw core::InputError(what + ": boundary triangle " + std::to_string(f)
                                     + " has the corner " + std::to_string(v)
                                     + ", which belongs to no tetrahedron. Remove the triangle.");
            v = number[v];
          }
      mesh.points.resize(n_used);
      return n_removed;
    }



    /** Coordinates must be finite and no two points the same. */
    void
    check_points(const TetMesh &mesh, const std::string &what)
    {
      std::vector<unsigned int> order(mesh.n_points());
      for (unsigned int v = 0; v < mesh.n_points(); ++v)
        {
          order[v] = v;
          for (unsigned int d = 0; d < 3; ++d)
            if (!std::isfinite(mesh.points[v][d]))
              throw core::InputError(what + ": point " + std::to_string(v) + " has the coordinate "
                                     + std::to_string(mesh.points[v][d]) + ".");
        }

      const auto compare = [&](const unsigned int a, const unsigned int b) {
        const Point<3> &p = mesh.points[a];
        const Point<3> &q = mesh.points[b];
        for (unsigned int d = 0; d < 3; ++d)
          if (p[d] != q[d])
            return p[d] < q[d];
        return a < b;
      };
      std::sort(order.begin(), order.end(), compare);
      for (unsigned int k = 1; k < order.size(); ++k)
        {
          const Point<3> &p = mesh.points[order[k - 1]];
          const Point<3> &q = mesh.points[order[k]];
          if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2])
            throw core::InputError(what + ": points " + std::to_string(order[k - 1]) + " and "
                                   + std::to_string(order[k]) + " (counted from 0) are both at "
                                   + to_string(p)
                                   + ", so the tetrahedra around them are not joined. Merge "
                                     "coincident points in the program that wrote the mesh.");
        }
    }



    /** Turns cells of negative volume and refuses flat ones. Returns how many
     * were turned. */
    unsigned int
    orient_cells(TetMesh &mesh, const std::string &what)
    {
      unsigned int n_flipped = 0;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          auto        &cell   = mesh.cells[c];
          double       length = 0., size = 0.;
          Tensor<1, 3> edges[3];
          for (unsigned int i = 0; i < 4; ++i)
            {
              for (unsigned int j = 0; j < i; ++j)
                length
                  = std::max(length, mesh.points[cell[i]].distance_square(mesh.points[cell[j]]));
              for (unsigned int d = 0; d < 3; ++d)
                size = std::max(size, std::abs(mesh.points[cell[i]][d]));
              if (i > 0)
                edges[i - 1] = mesh.points[cell[i]] - mesh.points[cell[0]];
            }
          length = std::sqrt(length);

          // The second term: rounding of coordinates far from the origin.
          const double volume   = dealii::cross_product_3d(edges[0], edges[1]) * edges[2];
          const double rounding = 4. * std::numeric_limits<double>::epsilon() * size;
          const double smallest = length * length * (1e-12 * length + rounding);
          if (!(std::abs(volume) > smallest) && rounding > 1e-3 * length)
            throw core::InputError(what + ": " + describe_cell(mesh, c)
                                   + " is too far from the origin for its size: rounding of its "
                                     "coordinates, "
                                   + number_text(rounding, 3) + ", leaves its edges of "
                                   + number_text(length, 6)
                                   + " without digits. Move the body to the origin.");
          if (!(std::abs(volume) > smallest))
            throw core::InputError(what + ": " + describe_cell(mesh, c) + " is flat: its volume is "
                                   + number_text(volume / 6., 6)
                                   + ". Repair the mesh in the program that made it.");
          if (volume < 0.)
            {
              std::swap(cell[2], cell[3]);
              ++n_flipped;
            }
        }
      return n_flipped;
    }
  } // namespace



  FinalizeReport
  finalize(TetMesh &mesh, const std::string &what)
  {
    FinalizeReport report;
    check_sizes(mesh, what);
    report.removed_points = remove_unused_points(mesh, what);
    check_points(mesh, what);
    report.flipped_cells = orient_cells(mesh, what);

    complete_boundary(mesh, what, report);
    return report;
  }



  std::string
  to_string(const Point<3> &point)
  {
    std::string text = "(";
    for (unsigned int d = 0; d < 3; ++d)
      {
        std::string number = number_text(point[d], 6);
        if (std::strtod(number.c_str(), nullptr) != point[d])
          number = number_text(point[d], 17);
        text += (d ? ", " : "") + number;
      }
    return text + ")";
  }
} // namespace tetradapt::mesh
