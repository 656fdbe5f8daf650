// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/embedding.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/triangle_conflicts.h"
#include "tetradapt/mesh/face_table.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    using Kind = geometry::TriangleConflict::Kind;

    /** Gaps narrower than this part of a triangle's size are warned of. */
    constexpr double narrow = 1e-3;

    /** For every boundary face the part that its cell belongs to. */
    std::vector<unsigned int>
    parts_of_faces(const TetMesh &mesh, const std::vector<unsigned int> &part_of)
    {
      // A face has one cell, so its three points and the part tell it apart; parts that
      // touch in a point share that one only.
      std::vector<std::vector<unsigned int>> cells_of(mesh.n_points());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (const unsigned int v : mesh.cells[c])
          cells_of[v].push_back(c);
      std::vector<unsigned int> parts(mesh.faces.size(), 0);
      for (unsigned int f = 0; f < mesh.faces.size(); ++f)
        {
          const auto &v = mesh.faces[f].vertices;
          for (const unsigned int c : cells_of[v[0]])
            {
              const auto &cell = mesh.cells[c];
              if (std::count(cell.begin(), cell.end(), v[1]) > 0
                  && std::count(cell.begin(), cell.end(), v[2]) > 0)
                parts[f] = part_of[c];
            }
        }
      return parts;
    }

    void
    refuse_or_warn(const geometry::TriangleConflict &conflict,
                   const std::size_t                 n_conflicts,
                   const TetMesh                    &mesh,
                   const std::string                &what,
                   const core::Log                  &log)
    {
      std::ostringstream text;
      const std::string  place = to_string(conflict.place);
      if (conflict.kind == Kind::crossing)
        {
          text << what << ": the body penetrates itself, first seen near " << place << " (boundary "
               << "triangles " << conflict.first << " and " << conflict.second << "; "
               << n_conflicts << " pairs in all). The cells' volumes add up to "
               << total_volume(mesh) << ", but some space is counted twice. Repair the mesh in "
               << "the program that made it.";
          throw core::InputError(text.str());
        }
      if (conflict.kind == Kind::interface)
        {
          text << what << ": two parts of the body touch near " << place
               << ", but do not have the same triangles there (" << n_conflicts
               << " pairs), so that they are not joined. Mesh them together, with the same "
               << "triangles on both sides of the interface, or move them apart.";
          throw core::InputError(text.str());
        }
      text << what << ": parts of the body are separated by a gap of " << conflict.distance
           << " near " << place << " (" << n_conflicts << " pairs of triangles), far smaller than "
           << "the elements there. They are not joined, and no contact is computed. If they "
           << "are to be one body, mesh them together.";
      log.warning(text.str());
    }

    /** Whether @p p lies in a cell, its faces included. */
    bool
    contains(const TetMesh &mesh, const unsigned int cell, const Point<3> &p)
    {
      const double rounding = 1e-12 * cell_volume(mesh, cell);
      for (unsigned int i = 0; i < 4; ++i)
        {
          std::array<Point<3>, 4> x;
          for (unsigned int j = 0; j < 4; ++j)
            x[j] = j == i ? p : mesh.points[mesh.cells[cell][j]];
          if (!(dealii::cross_product_3d(x[1] - x[0], x[2] - x[0]) * (x[3] - x[0]) >= -rounding))
            return false;
        }
      return true;
    }

    /** No part inside another one. Their boundaries do not cross, so that one point of
     * each part is enough. */
    void
    check_containment(const TetMesh                   &mesh,
                      const std::vector<unsigned int> &part_of,
                      const std::string               &what)
    {
      std::vector<Point<3>> sample; // one a part: the centre of its first cell
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (part_of[c] == sample.size())
          {
            Tensor<1, 3> sum;
            for (const unsigned int v : mesh.cells[c])
              sum += Tensor<1, 3>(mesh.points[v]);
            sample.emplace_back(sum / 4.);
          }
      if (sample.size() < 2)
        return;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int part = 0; part < sample.size(); ++part)
          if (part != part_of[c] && contains(mesh, c, sample[part]))
            throw core::InputError(what + ": a part of the body lies inside another one, at "
                                   + to_string(sample[part])
                                   + ", so that this space is filled twice. Remove one of them.");
    }
  } // namespace

  void
  check_embedding(const TetMesh &mesh, const std::string &what, const core::Log &log)
  {
    const std::vector<unsigned int> part_of = connected_components(mesh);
    geometry::SurfaceMesh           boundary;
    boundary.points = mesh.points;
    boundary.triangles.reserve(mesh.faces.size());
    for (const auto &face : mesh.faces)
      boundary.triangles.push_back(face.vertices);
    const auto conflicts
      = geometry::triangle_conflicts(boundary, parts_of_faces(mesh, part_of), narrow);
    if (!conflicts.empty())
      refuse_or_warn(conflicts.front(), conflicts.size(), mesh, what, log);
    check_containment(mesh, part_of, what);
  }
} // namespace tetradapt::mesh
